#include "trial.hpp"

#include <cmath>
#include <limits>

#include "berth/distance/evaluate.hpp"
#include "berth/self_filter/self_filter.hpp"
#include "testing/other_metric.hpp"
#include "testing/sensor_model.hpp"

namespace berth {
namespace {

DepthImage sense(const SensorErrors& errors, std::uint32_t seed, DepthImage depth_m) {
  if (errors.outline_px > 0) testing::darken_outlines(errors.outline_px, depth_m);
  if (errors.mixed_share > 0) testing::mix_edge_pixels(errors.mixed_share, seed + 1, depth_m);
  if (errors.noise_m_at_1m > 0) testing::add_noise(errors.noise_m_at_1m, seed + 2, depth_m);
  if (errors.step_m_at_1m > 0) testing::quantise(errors.step_m_at_1m, depth_m);
  if (errors.dropout_share > 0) testing::drop_out(errors.dropout_share, seed + 3, depth_m);
  return depth_m;
}

/// The robot where berth believes that it is.
RobotImage render_believed(const TrialRobot& robot, const testing::DrawnScene& scene,
                           const SensorErrors& errors, std::uint32_t seed) {
  const Pose X_BC =
      testing::miscalibrated(scene.X_BC, errors.calibration_m, errors.calibration_rad, seed + 4);
  const JointState joints =
      testing::delayed(robot.model, scene.joints, errors.delay_s, kTrialJointSpeed_per_s, seed + 5);
  RobotPose pose;
  forward_kinematics(robot.model, joints.position, pose);
  RobotImage image;
  RobotRenderer(robot.meshes, scene.camera).render(pose, X_BC, image);
  return image;
}

/// Removes what shows the robot in truth.
void remove_robot(const testing::DrawnScene& scene, DepthImage& depth_m) {
  for (std::size_t i = 0; i < depth_m.pixels().size(); ++i) {
    if (std::isnan(scene.obstacle_depth_m.pixels()[i])) depth_m.pixels()[i] = kNoDepth;
  }
}

std::vector<Estimate> to_estimates(const LinkDistances& distances) {
  std::vector<Estimate> estimates;
  for (const LinkDistance& link : distances.links) {
    estimates.push_back({link.status, link.distance_m});
  }
  return estimates;
}

std::vector<Estimate> evaluate_berth(const TrialRobot& robot, const Camera& camera,
                                     const RobotImage& image, const DepthImage& obstacle_depth_m) {
  ObstacleTree tree;
  build_obstacle_tree(obstacle_depth_m, tree);
  EvaluateWorkspace workspace;
  LinkDistances distances;
  evaluate(Method::exact, camera, image, obstacle_depth_m, tree, robot.model.link_count(),
           {.range_m = kTrialRange_m, .mean_direction = false}, workspace, distances);
  return to_estimates(distances);
}

std::vector<Estimate> evaluate_other(testing::OtherMetric metric, const TrialRobot& robot,
                                     const Camera& camera, const RobotImage& image,
                                     const DepthImage& obstacle_depth_m) {
  std::vector<bool> is_visible(robot.model.link_count() + 1, false);
  for (const LinkId id : image.link_id.pixels()) {
    if (id != kEnvironmentLink) is_visible[id] = true;
  }
  std::vector<Estimate> estimates;
  for (const auto& distance_m : testing::other_distances_m(
           metric, camera, image, obstacle_depth_m, robot.model.link_count(), kTrialRange_m)) {
    const bool seen = is_visible[estimates.size() + 1];
    const LinkStatus unset = seen ? LinkStatus::none_in_range : LinkStatus::not_visible;
    estimates.push_back({distance_m ? LinkStatus::ok : unset,
                         distance_m.value_or(std::numeric_limits<double>::quiet_NaN())});
  }
  return estimates;
}

}  // namespace

TrialRobot make_trial_robot(std::string name, RobotModel model) {
  auto link_trees = testing::build_link_trees(model);
  auto meshes = build_link_meshes(model);
  return {std::move(name), std::move(model), std::move(link_trees), std::move(meshes)};
}

std::vector<Estimate> estimate(const TrialRobot& robot, const testing::DrawnScene& scene,
                               const Condition& condition, std::uint32_t seed) {
  const Camera& camera = scene.camera;
  const RobotImage image = render_believed(robot, scene, condition.errors, seed);
  DepthImage depth_m = sense(condition.errors, seed, scene.depth_m);
  if (condition.filter == MeasuredFilter::ideal) {
    remove_robot(scene, depth_m);
  } else {
    SelfFilterWorkspace workspace;
    ObstacleImage obstacles;
    self_filter(camera, depth_m, image, condition.self_filter, workspace, obstacles);
    depth_m = std::move(obstacles.depth_m);
  }
  switch (condition.metric) {
    case MeasuredMetric::reading:
      return evaluate_other(testing::OtherMetric::reading, robot, camera, image, depth_m);
    case MeasuredMetric::hidden_ray:
      return evaluate_other(testing::OtherMetric::hidden_ray, robot, camera, image, depth_m);
    case MeasuredMetric::hirt:
      break;
  }
  return evaluate_berth(robot, camera, image, depth_m);
}

Trial run_trial(const TrialRobot& robot, const testing::DrawnSceneSettings& settings,
                std::uint32_t seed, const std::vector<Condition>& conditions) {
  const testing::DrawnScene scene =
      testing::draw_scene(robot.model, robot.link_trees, settings, seed);
  Trial trial{&robot,
              seed,
              scene.camera,
              testing::true_distances(robot.model, robot.link_trees, scene),
              {}};
  for (const Condition& condition : conditions) {
    trial.estimates.push_back(estimate(robot, scene, condition, seed));
  }
  return trial;
}

}  // namespace berth
