// The panel beside the image: the nearest link, the table of links, the fates of the pixels, the
// depth scale.
#pragma once

#include "apps/berth/picture.hpp"
#include "apps/berth/picture_canvas.hpp"
#include "apps/berth/picture_layout.hpp"
#include "apps/berth/picture_pixels.hpp"

namespace berth::app {

inline constexpr Rgb kPaper{0x15, 0x18, 0x1D};
inline constexpr Rgb kInk{0xEC, 0xEE, 0xF1};
inline constexpr Rgb kFaintInk{0x98, 0xA0, 0xAA};

void draw_legend(PictureCanvas& canvas, const PictureLayout& layout, const PictureInput& input,
                 const DepthTone& tone);

}  // namespace berth::app
