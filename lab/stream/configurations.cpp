#include "lab/stream/configurations.hpp"

#include <fmt/format.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "berth/pipeline/configuration_check.hpp"
#include "berth/pipeline/observer.hpp"
#include "berth/pipeline/query.hpp"
#include "lab/measure/stopwatch.hpp"
#include "lab/stream/film.hpp"

namespace berth::lab {
namespace {

using FrameList = std::vector<std::shared_ptr<const Frame>>;

std::size_t nearest_image(const FilmedCamera& camera, double time_s) {
  const auto nearest = std::ranges::min_element(
      camera.stamps_s, {}, [&](double stamp_s) { return std::abs(stamp_s - time_s); });
  return static_cast<std::size_t>(nearest - camera.stamps_s.begin());
}

/// When images of all cameras were taken as nearly at one time as ever: a planner waits for that.
double common_time_s(const Film& film) {
  const auto apart_s = [&](double time_s) {
    double most_s = 0;
    for (const FilmedCamera& camera : film.cameras) {
      most_s = std::max(most_s, std::abs(camera.stamps_s[nearest_image(camera, time_s)] - time_s));
    }
    return most_s;
  };
  return *std::ranges::min_element(film.cameras.front().stamps_s, {}, apart_s);
}

FrameList frames_at(const Film& film, double time_s) {
  FrameList frames;
  for (const FilmedCamera& camera : film.cameras) {
    const std::size_t image = nearest_image(camera, time_s);
    JointState joints;
    (void)film.joints->at(camera.stamps_s[image], kAnyGap, joints);
    auto frame = std::make_shared<Frame>();
    Observer(camera.mounted).observe(camera.depth_m[image], joints, *frame);
    frames.push_back(std::move(frame));
  }
  return frames;
}

std::vector<JointState> states_of(const std::vector<double>& positions, std::size_t joints,
                                  std::size_t count) {
  std::vector<JointState> out;
  for (std::size_t i = 0; i < count; ++i) {
    const auto first = positions.begin() + static_cast<std::ptrdiff_t>(joints * i);
    out.push_back({0, {first, first + static_cast<std::ptrdiff_t>(joints)}});
  }
  return out;
}

/// Whether the exact search contradicts the verdict.
bool is_wrong(Verdict verdict, const std::vector<WholeLinkDistance>& pose, const Robot& robot,
              double margin_m) {
  bool may_be_near = false, is_near = false;
  for (const WholeLinkDistance& link : pose) {
    const std::size_t index = robot.model().evaluated_links[link.id - 1];
    if (!robot.model().is_moved(index)) continue;
    may_be_near |= link.nearest.lower_bound_m <= margin_m;
    is_near |= link.nearest.distance_m <= margin_m;
  }
  return (verdict == Verdict::free && is_near) || (verdict == Verdict::near && !may_be_near);
}

}  // namespace

std::vector<double> draw_configurations(const RobotModel& model, std::size_t count,
                                        sim::Random& random) {
  constexpr double kTurn = 3.14;
  std::vector<double> out;
  for (std::size_t i = 0; i < count; ++i) {
    for (const MovableJoint& joint : model.joints) {
      out.push_back(random(std::max(joint.lower, -kTurn), std::min(joint.upper, kTurn)));
    }
  }
  return out;
}

std::string run_configurations(const StreamSettings& stream,
                               const ConfigurationSettings& settings) {
  constexpr std::size_t kMostAhead = 200, kMostOpen = 50;
  const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
  const Film film = film_of(stream);
  const FrameList frames = frames_at(film, common_time_s(film));
  const std::size_t joints = film.robot->model().joints.size();
  sim::Random random(1);
  const std::vector<double> positions =
      draw_configurations(film.robot->model(), settings.count, random);

  // The second time, memory and what depends on the robot alone are there.
  ConfigurationCheck check(film.robot);
  check.prepare(frames);
  const Stopwatch preparing(CLOCK_THREAD_CPUTIME_ID);
  check.prepare(frames);
  const double field_ms = preparing.ms();

  std::vector<Verdict> verdicts(settings.count);
  check.ask(positions, {.margin_m = settings.margin_m}, verdicts);
  const Stopwatch asking(CLOCK_THREAD_CPUTIME_ID);
  check.ask(positions, {.margin_m = settings.margin_m}, verdicts);
  const double ask_ms = asking.ms();

  Query query(film.robot);
  const std::vector<JointState> ahead =
      states_of(positions, joints, std::min(settings.count, kMostAhead));
  query.ask({.frames = frames});
  const Stopwatch looking(CLOCK_THREAD_CPUTIME_ID);
  const LookAhead& found = query.ask({.frames = frames, .ahead = ahead}).ahead;
  const double ahead_ms = looking.ms();
  std::size_t wrong = 0;
  for (std::size_t i = 0; i < found.poses.size(); ++i) {
    wrong += is_wrong(verdicts[i], found.poses[i], *film.robot, settings.margin_m);
  }

  std::vector<double> open;
  for (std::size_t i = 0; i < settings.count && open.size() < joints * kMostOpen; ++i) {
    if (verdicts[i] != Verdict::undecided) continue;
    for (std::size_t j = 0; j < joints; ++j) open.push_back(positions[joints * i + j]);
  }
  const std::vector<JointState> of_open = states_of(open, joints, open.size() / joints);
  const Stopwatch searching(CLOCK_THREAD_CPUTIME_ID);
  query.ask({.frames = frames, .ahead = of_open});
  const double exact_ms = searching.ms();
  std::vector<Verdict> resolved(of_open.size(), Verdict::undecided);
  const Stopwatch resolving(CLOCK_THREAD_CPUTIME_ID);
  check.resolve(open, {.margin_m = settings.margin_m}, resolved);
  const double resolve_ms = resolving.ms();

  const auto share = [&](std::size_t part) {
    return static_cast<double>(part) / static_cast<double>(settings.count);
  };
  const auto count_of = [&](Verdict verdict) {
    return static_cast<std::size_t>(std::ranges::count(verdicts, verdict));
  };
  const nlohmann::ordered_json out{
      {"configurations_per_s", 1000 * static_cast<double>(settings.count) / ask_ms},
      {"undecided_share", share(count_of(Verdict::undecided))},
      {"free_share", share(count_of(Verdict::free))},
      {"field_ms", field_ms},
      {"ahead_per_s", 1000 * static_cast<double>(ahead.size()) / ahead_ms},
      {"resolve_by_exact", of_open.empty() ? 0 : resolve_ms / exact_ms},
      {"compared", ahead.size()},
      {"wrong", wrong}};
  if (stream.as_json) return out.dump() + "\n";
  std::string lines;
  for (const auto& [name, value] : out.items())
    lines += fmt::format("{}: {}\n", name, value.dump());
  return lines;
}

}  // namespace berth::lab
