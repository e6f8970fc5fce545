#pragma once

#include "berth/pipeline/mounted_camera.hpp"

namespace berth {

/// Z_d of one camera for an obstacle at a depth of depth_m near the link: what the self filter
/// takes away beside the robot (tolerance or padding, whichever is more) and the noise of a
/// reading.
double camera_uncertainty_m(const CameraSettings& settings, LinkId link, double depth_m);

}  // namespace berth
