#include "sim/plain_hiding.hpp"

#include <algorithm>
#include <cmath>

#include "sim/plain_closing.hpp"

namespace berth::sim {

DepthImage plainly_hidden_from(const Camera& camera, const DepthImage& sensor_depth_m,
                               const DepthImage& obstacle_depth_m, const Image<PixelFate>& fate,
                               const DepthImage& own_m, const SpaceSettings& settings) {
  const auto thickness_m = static_cast<float>(settings.surface_thickness_m);
  const float beyond_m = plainly_counted(static_cast<float>(plainly_told_m(settings, camera) / 2 +
                                                            settings.free_space_margin_m +
                                                            settings.surface_thickness_m));
  DepthImage from_m(camera.width_px, camera.height_px, HUGE_VALF);
  for (int v = 0; v < camera.height_px; ++v) {
    for (int u = 0; u < camera.width_px; ++u) {
      float& hides_m = from_m(u, v);
      if (fate(u, v) == PixelFate::flying_patch) {
        if (!std::isnan(sensor_depth_m(u, v))) hides_m = plainly_counted(sensor_depth_m(u, v));
        continue;
      }
      const float kept_m = obstacle_depth_m(u, v);
      if (!std::isnan(kept_m)) hides_m = plainly_counted(kept_m + thickness_m);
      if (fate(u, v) != PixelFate::hole) continue;
      hides_m = std::min(hides_m, own_m(u, v) + beyond_m);
    }
  }
  return from_m;
}

double plainly_hidden_to(const DepthImage& environment_front_m, Pixel pixel) {
  double greatest_m = 0;
  for (int v = pixel.v - 1; v <= pixel.v + 1; ++v) {
    for (int u = pixel.u - 1; u <= pixel.u + 1; ++u) {
      const bool is_inside =
          u >= 0 && v >= 0 && u < environment_front_m.width() && v < environment_front_m.height();
      if (!is_inside || std::isnan(environment_front_m(u, v))) return HUGE_VAL;
      greatest_m = std::max(greatest_m, std::ceil(environment_front_m(u, v) * 2048.0) / 2048);
    }
  }
  return greatest_m;
}

}  // namespace berth::sim
