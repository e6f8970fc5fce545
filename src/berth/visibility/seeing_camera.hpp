#pragma once

#include "berth/types/camera.hpp"
#include "berth/visibility/line_of_sight.hpp"

namespace berth {

/// One camera's frame for find_whole_robot_visibility().
struct SeeingCamera {
  SeenFrame frame;
  /// The raw image.
  DepthView sensor_depth_m;
  Pose X_CB;
};

}  // namespace berth
