#pragma once

#include <limits>

namespace berth {

/// What is known of whether a camera stands where it should (PoseWatch).
struct CameraWatch {
  /// Whether anybody looks whether it was bumped.
  bool is_on = false;
  /// It does not: its frames are not used.
  bool has_moved = false;
  /// The robot is not where it should be in its images, from the first one on or since some of them:
  /// something that it is told by is wrong. Its frames are not used.
  bool is_implausible = false;
  /// Something stands before so much of the robot that the frame does not tell whether the rest is
  /// where it should be. No mistake: the frame is used.
  bool is_hidden = false;
  /// T, the share of the robot's readings in the frame that lie behind the robot's surface; NaN
  /// where too little of the robot is seen.
  double seen_through = std::numeric_limits<double>::quiet_NaN();
  /// D, by how much the robot has to be moved to fit an image, as it was measured last: in this
  /// frame or one before; NaN until it was.
  double displacement_m = std::numeric_limits<double>::quiet_NaN();
  /// The share of the robot's readings that lie at its surface, hidden ones left out; NaN where too
  /// little of the robot is seen, or nobody looks.
  double at_robot = std::numeric_limits<double>::quiet_NaN();

  bool is_trusted() const { return !has_moved && !is_implausible; }
};

}  // namespace berth
