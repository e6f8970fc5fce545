// Inside calibration/ only: what filter and sensor rules leave of an image that something was drawn
// into.
#pragma once

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
  /// What is left of `depth_m` in place of the camera's own image, as if nothing were known of
  /// earlier images. Valid until the next call.
  const ObstacleImage& run(const FilteredCamera& camera, DepthView depth_m);

 private:
  SelfFilterWorkspace workspace_;
  SensorWorkspace sensor_workspace_;
  PhantomWorkspace phantoms_;
  ObstacleImage out_;
};

}  // namespace berth
