#pragma once

#include <span>

#include "berth/types/image.hpp"
#include "berth/types/robot_image.hpp"

namespace berth {

/// A reading this far behind the model's surface shows something behind the robot.
inline constexpr float kSeenThrough_m = 0.05F;
/// One within this of the surface leaves no room for a mistake, where the sensor is that good.
inline constexpr float kClose_m = 0.015F;
/// One this far before it shows something else, which hides the robot. In between, the robot itself
/// may be nearer than it should be.
inline constexpr float kHidden_m = 0.2F;

/// What a depth image says at the pixels where the robot should be, counted in some of the rows.
/// Environment is left out: its many pixels hide what the arm's few say, and a table that is seen
/// at a flat angle says little of a camera that moved sideways.
struct RobotReadings {
  /// Within kSeenThrough_m of the robot's surface.
  int at_surface = 0;
  /// Of these, within kClose_m of it.
  int close = 0;
  /// Farther behind it: the robot is not there, or not all of it.
  int behind = 0;
  /// Before it by up to kHidden_m.
  int before = 0;
  /// Farther before it.
  int hidden = 0;
  /// Pixels of the robot without a reading.
  int none = 0;

  /// The pixels that T is a share of: neither hidden nor nearer than they should be.
  int judged() const { return at_surface + behind; }
  /// T, the share of the judged pixels that are seen through; NaN where none is judged.
  double seen_through() const;
  /// The share of the judged pixels that are at the surface; NaN where none is judged.
  double at_robot() const;
  /// Whether enough is judged, and little enough hidden, for these shares to tell anything: what is
  /// left of a robot that is hidden further is its outline.
  bool tells() const;
  /// Whether it is too much hidden for that.
  bool is_hidden() const;
  /// The share of the pixels with a reading that are hidden; NaN where there is none.
  double hidden_share() const;

  RobotReadings& operator+=(const RobotReadings& more);
};

/// A frame says nothing of T where fewer of the pixels looked at are judged, or where a larger
/// share of the robot is hidden.
inline constexpr int kLeastJudgedPixels = 100;
inline constexpr double kMostHiddenForSeenThrough = 0.8;

/// Both images have one size. Looks at rows that lie evenly over the robot's extent in the image,
/// at no more than kMostReadPixels pixels. Readings are known to lie `bias_m` behind the surface.
RobotReadings read_robot(DepthView depth_m, const RobotImage& robot, double bias_m = 0);

inline constexpr int kMostReadPixels = 20000;

/// The same link by link, added to `of_link`, whose item i is that of link ID i + 1.
void read_links(DepthView depth_m, const RobotImage& robot, double bias_m,
                std::span<RobotReadings> of_link);

}  // namespace berth
