// What every method is asked about.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "berth/robot/triangle_mesh.hpp"
#include "berth/types/camera.hpp"
#include "berth/types/robot_image.hpp"

namespace berth::lab {

/// The links' shapes, known before any frame; [i] is that of the link with the id i + 1.
using LinkShapes = std::vector<TriangleMesh>;

/// One frame: the robot's image, the obstacles' image, and for methods that want it the robot
/// itself.
struct BenchScene {
  Camera camera;
  RobotImage robot;
  DepthImage obstacle_depth_m;
  int link_count = 0;
  double range_m = 1;
  std::shared_ptr<const LinkShapes> shapes_L;
  /// The pose of each link's frame L in the camera's optical frame C.
  std::vector<Pose> X_CL;
};

/// Scenes that share a table; made one at a time, since all together are large.
struct SceneSet {
  std::string title;
  std::string note;
  int count = 0;
  /// Scene 0 to count - 1; asked for in this order.
  std::function<BenchScene(int)> make;
};

}  // namespace berth::lab
