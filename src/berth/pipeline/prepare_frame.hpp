#pragma once

#include "berth/pipeline/frame.hpp"

namespace berth {

/// Makes of a frame's images what they say of space. `sensor_depth_m` is the image that
/// frame.obstacles was made of.
void prepare_frame(DepthView sensor_depth_m, DepthView environment_back_m, FrameUse use,
                   Frame& frame);

}  // namespace berth
