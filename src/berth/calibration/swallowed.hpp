// Inside calibration/ only: how small a thing may be before the filter takes it away, measured by
// drawing it into the images.
#pragma once

#include <vector>

#include "berth/calibration/filter_settings.hpp"
#include "berth/self_filter/drop_soft.hpp"
#include "berth/self_filter/self_filter.hpp"
#include "berth/sensor/phantoms.hpp"
#include "berth/sensor/sensor_rules.hpp"
#include "berth/types/camera.hpp"

namespace berth {

/// One image with the robot in it, and how it is filtered.
struct FilteredCamera {
  const Camera* camera = nullptr;
  DepthView depth_m;
  const RobotImage* robot = nullptr;
  const SelfFilterSettings* self_filter = nullptr;
  const SensorSettings* sensor = nullptr;
  /// Null: none.
  const std::vector<PosedSoftBody>* soft = nullptr;
};

/// One for each thread.
class DrawnImageFilter {
 public:
  /// The obstacles of `depth_m` in place of the camera's own image, as if nothing were known of
  /// earlier images. Valid until the next call.
  const ObstacleImage& run(const FilteredCamera& camera, DepthView depth_m);

 private:
  SelfFilterWorkspace workspace_;
  SensorWorkspace sensor_workspace_;
  PhantomWorkspace phantoms_;
  ObstacleImage out_;
};

/// See SmallestObstacle. Over all views.
SmallestObstacle smallest_obstacle(const std::vector<FilteredCamera>& views, double depth_m);

/// See FilterProposal::rod_gap_m.
double least_rod_gap_m(const std::vector<FilteredCamera>& views);

}  // namespace berth
