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

/// What stands in the row of one link: its name at the left, its distance at the right, and whether
/// there is a bar between them.
struct LinkRow {
  std::string name;
  std::string distance;
  bool has_bar = false;
};

/// Both fit side by side into a column of the plan. em_px: the size of the legend's text.
LinkRow link_row(const PictureCanvas& canvas, const LinkResult& link, double range_m,
                 const TablePlan& plan, const Font& font, double em_px);

}  // namespace berth::app
