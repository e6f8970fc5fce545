#pragma once

#include "berth/types/camera.hpp"
#include "berth/types/depth_units.hpp"
#include "berth/visibility/line_of_sight.hpp"

namespace berth {

/// One camera's frame for find_whole_robot_visibility().
struct SeeingCamera {
  SeenFrame frame;
  /// The raw image, rounded down.
  const UnitImage& sensor_depth;
  Pose X_CB;
};

}  // namespace berth
