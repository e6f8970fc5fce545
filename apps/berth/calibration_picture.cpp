#include "apps/berth/calibration_picture.hpp"

#include <algorithm>
#include <cmath>

#include "apps/berth/enlarged_picture.hpp"
#include "apps/berth/residual_colors.hpp"
#include "berth/scene/calibrated_robot.hpp"

namespace berth::app {
namespace {

/// The brightness of all else, to make the robot stand out.
constexpr double kDimmed = 0.4;

bool is_robot_at(const CalibrationPicture& picture, int u, int v) {
  const Image<LinkId>& ids = picture.robot->link_id;
  return u >= 0 && v >= 0 && u < ids.width() && v < ids.height() && is_robot(ids(u, v));
}

/// Pixels of the robot at its edge, but not at the image's.
bool is_outline(const CalibrationPicture& picture, int u, int v) {
  if (!is_robot_at(picture, u, v)) return false;
  const auto is_open = [&](int du, int dv) {
    const int u2 = u + du, v2 = v + dv;
    const bool inside = u2 >= 0 && v2 >= 0 && u2 < picture.sensor_depth_m.width &&
                        v2 < picture.sensor_depth_m.height;
    return inside && !is_robot_at(picture, u2, v2);
  };
  return is_open(1, 0) || is_open(-1, 0) || is_open(0, 1) || is_open(0, -1);
}

/// x, y in the picture; stripes must not grow with the pixels.
Rgb color_at(const CalibrationPicture& picture, int u, int v, int x, int y) {
  constexpr int kStripe_px = 2;
  const float depth_m = picture.sensor_depth_m(u, v);
  if (is_outline(picture, u, v)) return std::isnan(depth_m) ? kBlindOutlineColor : kOutlineColor;
  if (std::isnan(depth_m)) return hatch(x, y, kStripe_px);
  if (picture.flying(u, v)) return kFlyingPixelColor;
  const float residual_m = picture.residual_m(u, v);
  if (std::isnan(residual_m)) return mix(picture.tone(depth_m), kBlack, kDimmed);
  if (std::abs(residual_m) <= kResidualScale_m) return residual_color(residual_m);
  const Stripes stripes = beyond_scale(residual_m);
  return (x + y) / kStripe_px % 3 == 0 ? stripes.light : stripes.dark;
}

}  // namespace

PixelRect robot_rect(const Image<LinkId>& link_id) {
  PixelRect rect{link_id.width(), link_id.height(), 0, 0};
  for (int v = 0; v < link_id.height(); ++v) {
    for (int u = 0; u < link_id.width(); ++u) {
      if (!is_robot(link_id(u, v))) continue;
      rect = {std::min(rect.u_begin, u), std::min(rect.v_begin, v), std::max(rect.u_end, u + 1),
              std::max(rect.v_end, v + 1)};
    }
  }
  return rect;
}

std::string calibration_picture_png(const CalibrationPicture& picture) {
  const PixelRect& part = picture.part;
  return enlarged_png(part.u_end - part.u_begin, part.v_end - part.v_begin,
                      [&](int u, int v, int x, int y) {
                        return color_at(picture, part.u_begin + u, part.v_begin + v, x, y);
                      });
}

}  // namespace berth::app
