// The calibration page's section about what the cameras detect.
#pragma once

#include <string>

#include "berth/calibration/detection_map.hpp"

namespace berth::app {

/// Sentences, and the map in slices, the lowest one first; empty where nobody measured it.
std::string detection_section(const DetectionMap& map);

}  // namespace berth::app
