// What the cameras of a scene detect once it is calibrated.
#pragma once

#include <functional>
#include <vector>

#include "berth/calibration/detection_map.hpp"
#include "berth/calibration/filter_settings.hpp"

namespace berth {

/// With the cameras where they were found, and the settings that were proposed. With
/// `corrects_depth` readings are taken as `found` corrects them.
DetectionMap measure_detection_of(const CalibrationData& calibration_data,
                                  const CalibrationResult& found,
                                  const std::vector<FilterProposal>& filters, bool corrects_depth,
                                  const std::function<void()>& pause);

}  // namespace berth
