#include "lab/stream/steps.hpp"

#include <nlohmann/json.hpp>

#include "berth/control/velocity_filter.hpp"
#include "berth/distance/known_distances.hpp"
#include "berth/pipeline/frame_pool.hpp"
#include "berth/pipeline/observer.hpp"
#include "berth/pipeline/prepared_space.hpp"
#include "berth/pipeline/query.hpp"
#include "lab/measure/stopwatch.hpp"
#include "lab/stream/percentiles.hpp"

namespace berth::lab {
namespace {

constexpr double kBudget_us = 500;
/// This first part of the requests and images is not counted: memory grows, fields fill.
constexpr double kWarmUpShare = 0.4;

/// What the requests are asked for.
enum class Told { distances, everything, in_budget };

std::shared_ptr<const Robot> robot_for(const Film& film, Told told) {
  EvaluationSettings settings = film.robot->settings();
  settings.distance.deadline_us.reset();
  settings.visibility = settings.distance.mean_direction = told == Told::everything;
  if (told == Told::in_budget) settings.distance.deadline_us = kBudget_us;
  return with_settings(film.robot, settings);
}

class Steps {
 public:
  Steps(const Film& film, const StreamSettings& settings, Told told)
      : film_(film),
        settings_(settings),
        play_{film.joints->first_s(), film.joints->last_s(), settings.speed, 0},
        robot_(robot_for(film, told)),
        query_(robot_),
        filter_(robot_, {}),
        frame_pools_(film.cameras.size()),
        frames_(film.cameras.size()) {
    for (const FilmedCamera& camera : film.cameras) {
      // Images are made for all that the scene reports, whatever is asked.
      observers_.emplace_back(camera.mounted);
    }
  }

  void run() {
    const auto shown = shown_images(film_, play_, settings_.seconds);
    std::size_t next = 0;
    for (double now_s = 0; now_s < settings_.seconds; now_s += 1 / settings_.rate_hz) {
      const bool counts = now_s >= kWarmUpShare * settings_.seconds;
      bool is_first = false;
      for (; next < shown.size() && shown[next].time_s <= now_s; ++next) {
        take_image(shown[next], now_s, counts);
        is_first = true;
      }
      if (prepared_) ask(now_s, is_first, counts);
    }
  }

  std::vector<double> observe_ms, prepare_ms, first_us, next_us, known_us, filter_us, gap_m;

 private:
  void joints_at(double time_s) {
    (void)film_.joints->at(play_.film_s(time_s), kAnyGap, joints_);
    joints_.stamp_s = time_s;
  }

  void take_image(const Shown& image, double now_s, bool counts) {
    joints_at(image.time_s);
    const std::shared_ptr<Frame> frame = frame_pools_[image.camera].take();
    const Stopwatch observing(CLOCK_THREAD_CPUTIME_ID);
    observers_[image.camera].observe(film_.cameras[image.camera].depth_m[image.frame], joints_,
                                     *frame);
    if (counts) observe_ms.push_back(observing.ms());
    frames_[image.camera] = frame;
    joints_at(now_s);
    const std::shared_ptr<PreparedSpace> space =
        space_pool_.take([&] { return std::make_unique<PreparedSpace>(robot_, frames_.size()); });
    const Stopwatch preparing(CLOCK_THREAD_CPUTIME_ID);
    space->prepare(frames_, &joints_);
    if (counts) prepare_ms.push_back(preparing.ms());
    prepared_ = space;
  }

  void ask(double now_s, bool is_first, bool counts) {
    joints_at(now_s);
    const Stopwatch asking(CLOCK_THREAD_CPUTIME_ID);
    const Result& result = query_.ask({.frames = prepared_, .joints = joints_});
    const double us = 1000 * asking.ms();
    if (!counts) return;
    (is_first ? first_us : next_us).push_back(us);
    // Once more by itself, for its share in the request.
    const Stopwatch asking_known(CLOCK_THREAD_CPUTIME_ID);
    known_distances(robot_->known(), result.pose, {.range_m = result.range_m}, known_workspace_,
                    known_);
    known_us.push_back(1000 * asking_known.ms());
    const Stopwatch filtering(CLOCK_THREAD_CPUTIME_ID);
    filter_.update(result, {joints_.position, still_, wanted_});
    filter_us.push_back(1000 * filtering.ms());
    for (const LinkResult& link : result.links) {
      if (link.has_distance()) gap_m.push_back(link.distance_m - link.lower_bound_m);
    }
  }

  const Film& film_;
  const StreamSettings& settings_;
  Play play_;
  std::shared_ptr<const Robot> robot_;
  std::vector<Observer> observers_;
  Query query_;
  VelocityFilter filter_;
  /// One for each camera, as LiveCamera has: its images have one size.
  std::vector<FramePool> frame_pools_;
  Pool<PreparedSpace> space_pool_;
  std::vector<std::shared_ptr<const Frame>> frames_;
  std::shared_ptr<const PreparedSpace> prepared_;
  JointState joints_;
  KnownWorkspace known_workspace_;
  std::vector<KnownPair> known_;
  /// All joints at once: somewhere something is in the way.
  std::vector<double> still_ = std::vector<double>(robot_->model().joints.size(), 0.0);
  std::vector<double> wanted_ = std::vector<double>(robot_->model().joints.size(), 0.5);
};

nlohmann::ordered_json times(const std::vector<double>& values) {
  return percentiles(values, {{"p50", 0.5}, {"p95", 0.95}, {"p99", 0.99}, {"max", 1}});
}

}  // namespace

nlohmann::ordered_json measure_steps(const Film& film, const StreamSettings& settings) {
  nlohmann::ordered_json out;
  Steps distances(film, settings, Told::distances);
  distances.run();
  out["observe_ms"] = times(distances.observe_ms);
  out["prepare_ms"] = times(distances.prepare_ms);
  out["first_us"] = times(distances.first_us);
  out["next_us"] = times(distances.next_us);
  out["known_us"] = times(distances.known_us);
  out["filter_us"] = times(distances.filter_us);
  Steps everything(film, settings, Told::everything);
  everything.run();
  out["next_with_all_us"] = times(everything.next_us);
  Steps in_budget(film, settings, Told::in_budget);
  in_budget.run();
  out["in_budget_us"] = times(in_budget.next_us);
  out["in_budget_gap_m"] = times(in_budget.gap_m);
  return out;
}

}  // namespace berth::lab
