// Inside calibration/ only: how small a thing may be before the filter takes it away, measured by
// drawing it into the images.
#pragma once

#include <vector>

#include "berth/calibration/filter_settings.hpp"
#include "berth/types/robot_image.hpp"

namespace berth {

/// One image with the robot in it, and how it is filtered.
struct FilteredCamera {
  const Camera* camera = nullptr;
  DepthView depth_m;
  const RobotImage* robot = nullptr;
  const SelfFilterSettings* self_filter = nullptr;
  const SensorSettings* sensor = nullptr;
};

/// See SmallestObstacle. Over all views.
SmallestObstacle smallest_obstacle(const std::vector<FilteredCamera>& views, double depth_m);

/// See FilterProposal::rod_gap_m.
double least_rod_gap_m(const std::vector<FilteredCamera>& views);

}  // namespace berth
