// Images of a calibration that show a part which the robot may carry.
#pragma once

#include <string>
#include <vector>

#include "berth/calibration/attached_parts.hpp"
#include "berth/fit/calibration_data.hpp"

namespace berth::app {

/// The bytes of a PNG, with the robot and the part drawn over the image.
struct PartPicture {
  std::string camera;
  int frame = 0;
  std::string png;
};

/// Of each camera that sees the part, the image that shows most of it.
std::vector<PartPicture> part_pictures(const CalibrationData& calibration_data,
                                       const CalibrationResult& found, const AttachedPart& part);

}  // namespace berth::app
