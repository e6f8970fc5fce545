#pragma once

#include "berth/self_filter/rows.hpp"
#include "berth/types/image.hpp"

namespace berth {

/// Turns the mixed pixels among the obstacles of row v into edges: readings between two flat
/// neighbours (left and right, or above and below) that are more than edge_jump_m max(1, z^2) from
/// both, z being the reading in metres: a sensor's steps and noise grow like that. What is nearer
/// than either of its neighbours, a rod of one pixel say, is never one, nor is a slope, since its
/// neighbours are not flat.
void mark_mixed_pixels(DepthView sensor_depth_m, int v, float edge_jump_m, const FilterRow& row);

}  // namespace berth
