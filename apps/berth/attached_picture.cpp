#include "apps/berth/attached_picture.hpp"

#include <cmath>

#include "apps/berth/enlarged_picture.hpp"
#include "berth/fit/robot_pixels.hpp"

namespace berth::app {
namespace {

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
  return enlarged_png(picture.sensor_depth_m.width, picture.sensor_depth_m.height,
                      [&](int u, int v, int, int) { return color_at(picture, u, v); });
}

}  // namespace berth::app
