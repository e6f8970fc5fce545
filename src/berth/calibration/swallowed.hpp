// Inside calibration/ only: how small a thing may be before the filter takes it away, measured by
// drawing it into the images.
#pragma once

#include <vector>

#include "berth/calibration/drawn_image_filter.hpp"
#include "berth/calibration/filter_settings.hpp"

namespace berth {

/// See SmallestObstacle. Over all views.
SmallestObstacle smallest_obstacle(const std::vector<FilteredCamera>& views, double depth_m);

/// See FilterProposal::rod_gap_m.
double least_rod_gap_m(const std::vector<FilteredCamera>& views);

}  // namespace berth
