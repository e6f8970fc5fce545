#include "lab/planning/configuration_room.hpp"

#include <tbb/global_control.h>

#include "berth/pipeline/observer.hpp"
#include "berth/robot/primitives.hpp"
#include "lab/stream/configurations.hpp"
#include "lab/stream/film.hpp"
#include "lab/trust/trial_robots.hpp"
#include "sim/sensor_model.hpp"

namespace berth::lab {
namespace {

Verdict verdict_of(const std::vector<SpacePair>& links, double margin_m) {
  const auto is_near = [&](const SpacePair& pair) { return pair.distance_m <= margin_m; };
  const auto is_free = [&](const SpacePair& pair) { return pair.lower_bound_m > margin_m; };
  if (std::ranges::any_of(links, is_near)) return Verdict::near;
  return std::ranges::all_of(links, is_free) ? Verdict::free : Verdict::undecided;
}

}  // namespace

void add_room_options(CLI::App& program, RoomOptions& options) {
  program.add_option("--robots", options.robots, "a folder of robots, besides the bundled arm")
      ->check(CLI::ExistingDirectory);
  program.add_option("--first", options.view.seed, "the first room's seed")->capture_default_str();
  program.add_option("--rooms", options.rooms, "how many")
      ->check(CLI::Range(1, 10000))
      ->capture_default_str();
  program.add_option("--cameras", options.view.cameras, "of each room")
      ->check(CLI::Range(1, 4))
      ->capture_default_str();
}

void for_each_room(const RoomOptions& options,
                   const std::function<void(const std::shared_ptr<const Robot>& robot,
                                            const RoomView& view)>& take) {
  const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
  EvaluationSettings settings;
  settings.visibility = settings.distance.mean_direction = false;
  const std::vector<TrialRobot> robots = load_trial_robots(options.robots);
  for (int i = 0; i < options.rooms; ++i) {
    const TrialRobot& robot = robots[static_cast<std::size_t>(i) % robots.size()];
    RoomView view = options.view;
    view.seed += static_cast<std::uint32_t>(i);
    take(std::make_shared<const Robot>(robot.model, settings), view);
  }
}

std::shared_ptr<const Robot> with_rod(const Robot& robot) {
  Attachment rod;
  rod.name = "rod";
  rod.link = robot.model().links[robot.model().evaluated_links.back()].name;
  rod.mesh_A = make_box(Eigen::Vector3d(0.03, 0.03, 0.3));
  return attach(robot, rod);
}

ConfigurationRoom::ConfigurationRoom(std::shared_ptr<const Robot> robot, const RoomView& view)
    : robot_(std::move(robot)), random_(view.seed) {
  CameraSettings settings;
  settings.watch.min_at_robot = 0;
  const Film film =
      film_of_room(robot_, settings, {.seed = view.seed}, static_cast<std::size_t>(view.cameras));
  JointState joints;
  for (const FilmedCamera& camera : film.cameras) {
    (void)film.joints->at(camera.stamps_s.front(), kAnyGap, joints);
    DepthImage depth_m = camera.depth_m.front();
    if (view.has_errors) sim::add_errors(sim::kKinectErrors, view.seed, depth_m);
    auto frame = std::make_shared<Frame>();
    Observer(camera.mounted).observe(depth_m, joints, *frame);
    frames_.push_back(std::move(frame));
  }
  position_ = joints.position;
}

std::vector<double> ConfigurationRoom::draw(std::size_t count, bool is_anywhere) {
  if (is_anywhere) return draw_configurations(robot_->model(), count, random_);
  std::vector<double> out;
  for (std::size_t i = 0; i < count; ++i) {
    for (const double position : position_) out.push_back(position + random_(-0.4, 0.4));
  }
  return out;
}

std::vector<JointState> states_of(std::span<const double> positions, std::size_t joints) {
  std::vector<JointState> out;
  for (std::size_t first = 0; first < positions.size(); first += joints) {
    const auto one = positions.subspan(first, joints);
    out.push_back({0, {one.begin(), one.end()}});
  }
  return out;
}

std::vector<std::vector<SpacePair>> ExactSearch::ask(std::span<const double> positions) {
  const RobotModel& model = robot_->model();
  const std::vector<JointState> ahead = states_of(positions, model.joints.size());
  std::vector<std::vector<SpacePair>> out;
  for (const auto& links : query_.ask({.frames = frames_, .ahead = ahead}).ahead.poses) {
    std::vector<SpacePair>& moved = out.emplace_back();
    for (const WholeLinkDistance& link : links) {
      if (model.is_moved(model.evaluated_links[link.id - 1])) moved.push_back(link.nearest);
    }
  }
  return out;
}

std::shared_ptr<const Robot> MarginSearch::within(const std::shared_ptr<const Robot>& robot,
                                                  double margin_m) {
  EvaluationSettings settings = robot->settings();
  settings.distance.range_m = margin_m + 0.002;
  return with_settings(robot, settings);
}

std::vector<Verdict> MarginSearch::ask(std::span<const double> positions) {
  std::vector<Verdict> verdicts;
  for (const auto& links : search_.ask(positions)) verdicts.push_back(verdict_of(links, margin_m_));
  return verdicts;
}

}  // namespace berth::lab
