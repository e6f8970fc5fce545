#pragma once

#include "berth/pipeline/frame.hpp"

namespace berth {

/// What a frame says of space, for method `mesh`: writes space, doubtful_space and is_blind of a
/// frame whose images are there. `as_obstacle` is memory that it uses.
void find_frame_space(DepthView sensor_depth_m, ObstacleImage& as_obstacle, Frame& frame);

}  // namespace berth
