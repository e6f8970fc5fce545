// Inside render/ only. Every instruction set computes the same bits.
#pragma once

#include <span>

#include "berth/render/draw_triangles.hpp"

namespace berth {

/// Writes row v of the image: within `extent` what the canvases show together, whose keys become 0
/// again, and nothing outside, where only `before` can hold a robot. Both lie in the image.
void show_row(std::span<Canvas> canvases, int v, const PixelRect& extent, const PixelRect& before,
              RobotImage& image);

}  // namespace berth
