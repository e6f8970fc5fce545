// Where the parts of the picture stand: a title above, the image at the left, the legend at the
// right.
#pragma once

#include "apps/berth/picture.hpp"
#include "apps/berth/picture_canvas.hpp"

namespace berth::app {

/// The legend's table of links.
struct TablePlan {
  int columns = 1;
  /// Rows of one column.
  int rows = 0;
  /// Height of a row, and widths of a link's name and of a whole column, in em.
  double row_em = 0;
  double name_em = 0;
  double column_em = 0;
  /// Links that are shown; where it is not all, a line below the table counts the others.
  int shown = 0;
};

struct PictureLayout {
  int width_px = 0;
  int height_px = 0;
  /// Picture pixels, in each direction, to one sensor pixel.
  int factor = 1;
  /// Size of the text; every other length of the drawing follows it.
  double em_px = 0;
  BoxPx title;
  BoxPx image;
  BoxPx legend;
  TablePlan table;

  /// The middle of a sensor pixel.
  PointPx centre(Pixel p) const {
    return {image.x + (p.u + 0.5) * factor, image.y + (p.v + 0.5) * factor};
  }
};

/// Heights of the legend's parts, in em.
inline constexpr double kHeadingEm = 1.8;
inline constexpr double kCardEm = 6.0;
inline constexpr double kKeyEm = 1.7;
inline constexpr double kHiddenKeyEm = 1.2;

/// Whether some pair leads to what no camera sees.
bool has_hidden(const PictureInput& input);
inline constexpr double kFateRowEm = 1.3;
inline constexpr double kScaleEm = 4.0;

/// The fates that the legend lists: those of the self filter up to `flying_patch`, and of the
/// others those that some pixel has.
std::vector<PixelFate> shown_fates(const ObstacleImage& obstacles);

PictureLayout layout_picture(const PictureInput& input);

}  // namespace berth::app
