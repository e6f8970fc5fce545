#pragma once

#include <cstdint>
#include <memory>

#include "berth/image_distance/image_visibility.hpp"
#include "berth/render/robot_renderer.hpp"
#include "berth/self_filter/self_filter.hpp"
#include "sim/embree_renderer.hpp"
#include "tests/image_distance/visibility/plain_definition.hpp"

namespace berth {

/// A robot at random joint angles before a random camera, with a wall, plates and patches without a
/// reading; and the same robot a little later, which is asked about.
class RandomView {
 public:
  RandomView(const RobotModel& model, const Camera& camera, std::uint32_t seed);

  SeenFrame frame() const { return {camera, robot, obstacles, tolerance_of(settings)}; }
  AskedRobot asked() const { return {asked_pose, X_BC, asked_robot}; }
  PlainView plain() const;
  Pose X_CL(std::size_t link) const { return X_BC.inverse() * asked_pose.X_BL[link]; }

  Camera camera;
  SelfFilterSettings settings;
  Pose X_BC;
  RobotPose pose;
  RobotPose asked_pose;
  RobotImage robot;
  RobotImage asked_robot;
  DepthImage sensor_depth_m;
  ObstacleImage obstacles;

 private:
  std::unique_ptr<sim::EmbreeRenderer> plain_robot_;
  std::unique_ptr<sim::EmbreeRenderer> plain_asked_robot_;
};

}  // namespace berth
