#pragma once

#include <limits>

namespace berth {

/// What is known of whether a camera stands where it should (PoseWatch).
struct CameraWatch {
  /// Whether anybody looks.
  bool is_on = false;
  /// It does not: its frames are not used.
  bool has_moved = false;
  /// T, the share of the robot's readings in the frame that lie behind the robot's surface; NaN
  /// where too little of the robot is seen.
  double seen_through = std::numeric_limits<double>::quiet_NaN();
  /// D, by how much the robot has to be moved to fit an image, as it was measured last: in this
  /// frame or one before; NaN until it was.
  double displacement_m = std::numeric_limits<double>::quiet_NaN();
};

}  // namespace berth
