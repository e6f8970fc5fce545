// A robot of few shapes before a wall, whose shares can be told in advance. Its root link's frame
// is the camera's.
#pragma once

#include <vector>

#include "berth/image_distance/image_visibility.hpp"
#include "berth/self_filter/self_filter.hpp"
#include "tests/render/small_robot.hpp"

namespace berth {

inline const Camera kPlainCamera{320, 240, 300, 300, 159.5, 119.5};

struct SmallWorld {
  /// The sensor sees the robot and a wall.
  SmallWorld(RobotModel robot_model, const std::vector<Pose>& X_CL, const Camera& any_camera);
  /// One link of each mesh.
  SmallWorld(std::vector<TriangleMesh> meshes, const std::vector<Pose>& X_CL,
             const Camera& any_camera = kPlainCamera)
      : SmallWorld(robot_of(std::move(meshes)), X_CL, any_camera) {}

  /// A sensor's readings in this rectangle, NaN for none.
  void put(const PixelRect& rect, float depth_m);
  /// The robot that is asked about moves; that of the exposure stays.
  void move_asked(const std::vector<Pose>& X_CL);
  SeenFrame frame() const { return {camera, robot, obstacles, tolerance_of(settings)}; }

  /// Each link with this answer; self filter included.
  std::vector<LinkVisibility> find(const LinkDistance& answer = {}, double range_m = 1);
  SightShares surface_of_first() { return find().front().surface; }
  /// Of the ball around a point in front of the first link.
  LinkVisibility around(const Eigen::Vector3f& robot_point_C_m, float radius_m);

  RobotModel model;
  Camera camera;
  SelfFilterSettings settings;
  RobotPose pose;
  RobotPose asked_pose;
  RobotImage robot;
  DepthImage sensor_depth_m;
  ObstacleImage obstacles;
};

inline constexpr float kWall_m = 5;

}  // namespace berth
