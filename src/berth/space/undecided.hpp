// What may be flying pixels or a thing, and what another view frees there by a rule alone.
#pragma once

#include <span>

#include "berth/space/unknown_space.hpp"

namespace berth {

/// Writes the readings of view k's flying patches that another view frees, and none sees through:
/// behind the robot and beside it a view frees what it does not see. NaN elsewhere. `fate` is that
/// of view k. Returns whether there are any.
bool find_undecided(std::span<const FreeingCamera> views, std::size_t k,
                    const Image<PixelFate>& fate, DepthImage& out_m);

}  // namespace berth
