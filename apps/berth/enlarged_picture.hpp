// Small pictures whose pixels can be told apart.
#pragma once

#include <functional>
#include <string>

#include "apps/berth/picture_palette.hpp"

namespace berth::app {

/// The bytes of a PNG file that shows width x height pixels, each enlarged as much as makes 600 of
/// the whole, at most four times. `color` is asked for the pixel u, v, and where in the picture it
/// is drawn, x, y. Throws std::runtime_error as PictureCanvas::png does.
std::string enlarged_png(int width, int height,
                         const std::function<Rgb(int u, int v, int x, int y)>& color);

}  // namespace berth::app
