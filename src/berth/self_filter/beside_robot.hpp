// Inside self_filter/ only.
#pragma once

#include <vector>

#include "berth/types/obstacle_image.hpp"

namespace berth {

/// Appends the pixels within `pixels` that have a neighbour (8) of fate `robot`, and the fate
/// `obstacle` or `padding`. Some may come twice.
void append_beside_robot(const Image<PixelFate>& fate, const PixelRect& pixels,
                         std::vector<Pixel>& found);

}  // namespace berth
