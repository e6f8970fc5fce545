#include "lab/trust/trial.hpp"

#include <fmt/format.h>

#include <array>
#include <atomic>
#include <cmath>
#include <limits>

#include "berth/render/robot_renderer.hpp"
#include "berth/self_filter/self_filter.hpp"
#include "berth/visibility/rejected.hpp"
#include "lab/measure/each_alone.hpp"
#include "lab/trust/scene_images.hpp"
#include "sim/other_metric.hpp"
#include "thesis/evaluate.hpp"

namespace berth::lab {

std::vector<Estimate> to_estimates(const LinkDistances& distances) {
  std::vector<Estimate> estimates;
  for (const LinkDistance& link : distances.links) {
    estimates.push_back({link.status, link.distance_m});
  }
  return estimates;
}

LinkDistances exact_distances(const Camera& camera, const RobotImage& image, int link_count,
                              const DepthImage& obstacle_depth_m) {
  SearchableDepth searchable;
  searchable.build(obstacle_depth_m);
  EvaluateWorkspace workspace;
  LinkDistances distances;
  evaluate(Method::exact,
           {camera,
            image,
            link_count,
            searchable,
            {{.range_m = kTrialRange_m, .mean_direction = false}, {}}},
           workspace, distances);
  return distances;
}

std::vector<Estimate> with_rejected(const Camera& camera, const RobotImage& image,
                                    DepthView sensed_m, const ObstacleImage& obstacles,
                                    const LinkDistances& distances) {
  std::vector<Estimate> estimates = to_estimates(distances);
  RejectedImage rejected;
  find_rejected(sensed_m, obstacles, rejected);
  const auto link_count = static_cast<int>(estimates.size());
  const auto nearer = to_estimates(exact_distances(camera, image, link_count, rejected.depth_m));
  for (std::size_t i = 0; i < estimates.size(); ++i) {
    const bool is_nearer = !(estimates[i].distance_m <= nearer[i].distance_m);
    if (nearer[i].status == LinkStatus::ok && is_nearer) estimates[i] = nearer[i];
  }
  return estimates;
}

namespace {

constexpr std::array<std::pair<int, int>, 3> kSizes_px = {{{224, 172}, {320, 240}, {640, 480}}};

/// Removes what shows the robot in truth.
void remove_robot(const sim::DrawnScene& scene, DepthImage& depth_m) {
  for (std::size_t i = 0; i < depth_m.pixels().size(); ++i) {
    if (std::isnan(scene.obstacle_depth_m.pixels()[i])) depth_m.pixels()[i] = kNoDepth;
  }
}

std::vector<Estimate> evaluate_other(sim::OtherMetric metric, const TrialRobot& robot,
                                     const Camera& camera, const RobotImage& image,
                                     const DepthImage& obstacle_depth_m) {
  std::vector<bool> is_visible(robot.model.link_count() + 1, false);
  for (const LinkId id : image.link_id.pixels()) {
    if (id != kEnvironmentLink) is_visible[id] = true;
  }
  std::vector<Estimate> estimates;
  for (const auto& distance_m : sim::other_distances_m(metric, camera, image, obstacle_depth_m,
                                                       robot.model.link_count(), kTrialRange_m)) {
    const bool seen = is_visible[estimates.size() + 1];
    const LinkStatus unset = seen ? LinkStatus::none_in_range : LinkStatus::not_visible;
    estimates.push_back({distance_m ? LinkStatus::ok : unset,
                         distance_m.value_or(std::numeric_limits<double>::quiet_NaN())});
  }
  return estimates;
}

std::vector<Estimate> estimate(const TrialRobot& robot, const sim::DrawnScene& scene,
                               const Condition& condition, SceneImages& images) {
  const Camera& camera = scene.camera;
  const RobotImage& image = images.believed(condition.pose);
  const DepthImage& sensed_m = images.sensed(condition.image);
  ObstacleImage obstacles;
  if (condition.filter == MeasuredFilter::ideal) {
    obstacles.depth_m = sensed_m;
    remove_robot(scene, obstacles.depth_m);
  } else {
    SelfFilterWorkspace workspace;
    self_filter(camera, sensed_m, image, condition.self_filter, workspace, obstacles);
  }
  const DepthImage& depth_m = obstacles.depth_m;
  switch (condition.metric) {
    case MeasuredMetric::reading:
      return evaluate_other(sim::OtherMetric::reading, robot, camera, image, depth_m);
    case MeasuredMetric::hidden_ray:
      return evaluate_other(sim::OtherMetric::hidden_ray, robot, camera, image, depth_m);
    case MeasuredMetric::hirt:
      break;
  }
  const LinkDistances distances = exact_distances(camera, image, robot.model.link_count(), depth_m);
  return condition.counts_rejected ? with_rejected(camera, image, sensed_m, obstacles, distances)
                                   : to_estimates(distances);
}

}  // namespace

TrialRobot make_trial_robot(std::string name, RobotModel model) {
  auto link_trees = sim::build_link_trees(model);
  auto meshes = build_link_meshes(model);
  return {std::move(name), std::move(model), std::move(link_trees), std::move(meshes)};
}

Trial run_trial(const TrialRobot& robot, const sim::DrawnSceneSettings& settings,
                std::uint32_t seed, const std::vector<Condition>& conditions) {
  const sim::DrawnScene scene = sim::draw_scene(robot.model, robot.link_trees, settings, seed);
  Trial trial{
      &robot, seed, scene.camera, sim::true_distances(robot.model, robot.link_trees, scene), {}};
  SceneImages images(robot.model, robot.meshes, scene, seed);
  for (const Condition& condition : conditions) {
    trial.estimates.push_back(estimate(robot, scene, condition, images));
  }
  return trial;
}

sim::DrawnSceneSettings trial_scene(int seed) {
  const auto [width_px, height_px] = kSizes_px[seed % kSizes_px.size()];
  return {.width_px = width_px, .height_px = height_px};
}

const TrialRobot& trial_robot(const std::vector<TrialRobot>& robots, int seed) {
  return robots[seed / kSizes_px.size() % robots.size()];
}

std::vector<Trial> run_trials(const std::vector<TrialRobot>& robots,
                              const std::vector<Condition>& conditions, int scenes) {
  std::vector<Trial> trials(scenes);
  std::atomic<int> done = 0;
  each_alone(scenes, [&](int i) {
    trials[i] = run_trial(trial_robot(robots, i), trial_scene(i), static_cast<std::uint32_t>(i),
                          conditions);
    if (++done % 50 == 0) fmt::print(stderr, "{} of {} scenes\n", done.load(), scenes);
  });
  return trials;
}

}  // namespace berth::lab
