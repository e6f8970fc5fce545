#include "apps/berth/enlarged_picture.hpp"

#include <algorithm>

#include "apps/berth/picture_canvas.hpp"

namespace berth::app {

std::string enlarged_png(int width, int height,
                         const std::function<Rgb(int u, int v, int x, int y)>& color) {
  constexpr int kLeastWidth_px = 600, kMostFactor = 4;
  const int factor = std::clamp((kLeastWidth_px + width - 1) / width, 1, kMostFactor);
  Image<std::uint32_t> pixels(width * factor, height * factor);
  for (int y = 0; y < pixels.height(); ++y) {
    for (int x = 0; x < pixels.width(); ++x) {
      const Rgb c = color(x / factor, y / factor, x, y);
      pixels(x, y) =
          static_cast<std::uint32_t>(c.r) << 16 | static_cast<std::uint32_t>(c.g) << 8 | c.b;
    }
  }
  PictureCanvas canvas(pixels.width(), pixels.height(), kBlack);
  canvas.pixels({0, 0}, pixels);
  return canvas.png();
}

}  // namespace berth::app
