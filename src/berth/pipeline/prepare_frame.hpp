#pragma once

#include "berth/pipeline/frame.hpp"
#include "berth/space/camera_space.hpp"

namespace berth {

/// Makes of a frame's images what they say of space. `sensor_depth_m` is the image that
/// frame.obstacles was made of.
void prepare_frame(DepthView sensor_depth_m, const EnvironmentSurfaces& environment, Frame& frame);

}  // namespace berth
