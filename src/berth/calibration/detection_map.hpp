// What the cameras of a cell detect together, measured by balls that are drawn into their images.
#pragma once

#include <Eigen/Core>
#include <array>
#include <functional>
#include <vector>

#include "berth/calibration/robot_reach.hpp"
#include "berth/self_filter/drop_soft.hpp"
#include "berth/self_filter/settings.hpp"
#include "berth/sensor/settings.hpp"
#include "berth/types/camera.hpp"
#include "berth/types/robot_image.hpp"

namespace berth {

/// One image, with the robot and the camera where they were.
struct DetectionImage {
  DepthImage depth_m;
  RobotImage robot;
  Pose X_BC = unset_pose();
  std::vector<PosedSoftBody> soft = {};
};

/// A camera with the settings that its images are filtered with.
struct DetectionCamera {
  Camera camera;
  SelfFilterSettings self_filter;
  SensorSettings sensor;
  /// In order of time, over the same time as the other cameras'; none: it sees nothing.
  std::vector<DetectionImage> images;
};

/// The balls that are drawn, m.
inline constexpr std::array kDrawnDiameters_m{0.010, 0.014, 0.020, 0.030, 0.040, 0.060, 0.080};

/// The least ball that is told at each place, m: of 50 draws in the cube around the place none is
/// missed, or of 20 and more where the others of 100 are hidden. Infinite where the largest one is
/// missed, too; NaN where fewer than 20 of 100 stand in view.
struct DetectedDiameters {
  std::vector<double> least_m;

  int in_view() const;
  /// Places in view where balls of this diameter are told.
  int told(double diameter_m) const;
  /// Over the places in view; NaN where there are none, infinite where not even the largest is told
  /// there.
  double median_m() const;
  double worst_m() const;
  /// Where that is, by its number; 0 where no place is in view.
  std::size_t worst_place() const;
};

/// Places of a cubic grid within the robot's reach.
struct DetectionMap {
  RobotReach reach;
  double step_m = 0;
  std::vector<Eigen::Vector3d> places_B_m;
  /// By all cameras together: a ball is told where one of them reports it.
  DetectedDiameters cell;
  /// By each one alone, in their order.
  std::vector<DetectedDiameters> cameras;

  bool empty() const { return places_B_m.empty(); }
};

/// Draws balls into the cameras' images, filters these, and counts of which ball no reading is
/// left. A ball has the noise and the dropouts that the image has there, and sharp outlines. Not
/// counted are balls that are mostly hidden, by the robot or by what is read, since hidden space is
/// unknown and told as that; balls that something seen goes through; and those within 8 cm of the
/// robot, where padding is. At most about 600 places. Calls `pause` now and then from the calling
/// thread. The result depends neither on threads nor on time.
DetectionMap measure_detection(const std::vector<DetectionCamera>& cameras, const RobotReach& reach,
                               const std::function<void()>& pause);

}  // namespace berth
