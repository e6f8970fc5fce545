// The picture's pixels below the lines: grey depth, coloured links, tinted filtered pixels.
#pragma once

#include <cstdint>

#include "apps/berth/picture.hpp"
#include "apps/berth/picture_palette.hpp"

namespace berth::app {

/// Grey for depth: near is bright, far is dark, by the logarithm of the depth.
struct DepthTone {
  /// 1 % and 99 % of the readings; NaN where there is not one reading.
  double near_m = kNoDepth;
  double far_m = kNoDepth;

  Rgb operator()(double depth_m) const;
};

/// Takes about a hundred thousand of the pixels as a sample.
DepthTone depth_tone(const DepthView& depth_m);

/// The colour of a stripe (or of what lies between two) where there is no reading; x, y in the
/// picture.
Rgb hatch(int x, int y, int stripe_px);

/// 0x00RRGGBB, `factor` picture pixels to each sensor pixel; links have dark outlines, `line_px`
/// wide.
Image<std::uint32_t> paint_pixels(const PictureInput& input, const DepthTone& tone, int factor,
                                  int line_px);

}  // namespace berth::app
