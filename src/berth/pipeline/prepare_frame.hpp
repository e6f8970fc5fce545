#pragma once

#include "berth/pipeline/frame.hpp"

namespace berth {

/// Makes of a frame's images what its robot's method asks: for `mesh` what they say of space, for
/// the others the images' trees. `sensor_depth_m` is the image that frame.obstacles was made of.
void prepare_frame(DepthView sensor_depth_m, Frame& frame);

}  // namespace berth
