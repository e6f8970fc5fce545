#include "apps/berth/attached_picture.hpp"

#include <algorithm>
#include <cmath>

#include "apps/berth/picture_canvas.hpp"
#include "berth/fit/robot_pixels.hpp"

namespace berth::app {
namespace {

constexpr int kLeastWidth_px = 600;
constexpr int kMostFactor = 4;
constexpr double kTinted = 0.45;

bool is_attached(const AttachedPicture& picture, int u, int v) {
  const Image<LinkId>& ids = picture.robot->link_id;
  if (u < 0 || v < 0 || u >= ids.width() || v >= ids.height()) return false;
  return is_robot(ids(u, v)) && ids(u, v) > picture.bare_links;
}

bool is_outline(const AttachedPicture& picture, int u, int v) {
  return !(is_attached(picture, u + 1, v) && is_attached(picture, u - 1, v) &&
           is_attached(picture, u, v + 1) && is_attached(picture, u, v - 1));
}

Rgb color_at(const AttachedPicture& picture, int u, int v) {
  const float depth_m = picture.sensor_depth_m(u, v);
  const Rgb grey = std::isnan(depth_m) ? kBlack : picture.tone(depth_m);
  if (is_attached(picture, u, v)) {
    return is_outline(picture, u, v) ? kAttachedColor : mix(grey, kAttachedColor, kTinted);
  }
  return is_robot(picture.robot->link_id(u, v)) ? mix(grey, kBareRobotColor, kTinted) : grey;
}

}  // namespace

std::string attached_picture_png(const AttachedPicture& picture) {
  const int width = picture.sensor_depth_m.width;
  const int height = picture.sensor_depth_m.height;
  const int factor = std::clamp((kLeastWidth_px + width - 1) / width, 1, kMostFactor);
  Image<std::uint32_t> pixels(width * factor, height * factor);
  for (int y = 0; y < pixels.height(); ++y) {
    for (int x = 0; x < pixels.width(); ++x) {
      const Rgb c = color_at(picture, x / factor, y / factor);
      pixels(x, y) =
          static_cast<std::uint32_t>(c.r) << 16 | static_cast<std::uint32_t>(c.g) << 8 | c.b;
    }
  }
  PictureCanvas canvas(pixels.width(), pixels.height(), kBlack);
  canvas.pixels({0, 0}, pixels);
  return canvas.png();
}

}  // namespace berth::app
