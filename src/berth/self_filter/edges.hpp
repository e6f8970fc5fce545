#pragma once

#include "berth/types/image.hpp"
#include "berth/types/obstacle_image.hpp"

namespace berth {

/// Marks as `edge` the mixed pixels among those marked `obstacle`: readings between two flat
/// neighbours (left and right, or above and below) that are more than edge_jump_m max(1, z^2) from
/// both, z being the reading in metres: a sensor's steps and noise grow like that. What is nearer
/// than either of its neighbours, a rod of one pixel say, is never one, nor is a slope, since its
/// neighbours are not flat.
void mark_mixed_pixels(DepthView sensor_depth_m, float edge_jump_m, Image<PixelFate>& fate);

}  // namespace berth
