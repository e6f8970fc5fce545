// How small a thing the cameras tell, for the monitor.
#pragma once

#include <span>
#include <string>

#include "berth/pipeline/mounted_camera.hpp"
#include "berth/pipeline/result.hpp"
#include "berth/separation/settings.hpp"

namespace berth {

/// The greatest detection_capability_m() of the cameras in use; 0 where none is.
double least_detection_m(std::span<const CameraResult> cameras);

/// That more may hide from this camera than the monitor was told the cameras detect, and what C is
/// for it; empty where it may not, or C does not follow from what is detected.
std::string detection_trouble(const SeparationSettings& settings, const MountedCamera& camera);

}  // namespace berth
