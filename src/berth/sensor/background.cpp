#include "berth/sensor/background.hpp"

#include <tbb/parallel_for.h>

#include <cmath>

#include "berth/self_filter/environment.hpp"
#include "berth/sensor/noise.hpp"

namespace berth {
namespace {

/// The self filter with these keeps what the grown links do not cover.
SelfFilterSettings clearance(double clearance_m) {
  SelfFilterSettings settings;
  settings.tolerance_m = settings.padding_depth_m = 1e6;  // all depths
  settings.padding_m = clearance_m;
  settings.edge_jump_m = 0;
  settings.flying_patch_radius_m = 0;
  return settings;
}

}  // namespace

void Background::learn(const Camera& camera, DepthView sensor_depth_m, const RobotImage& robot,
                       const Image<PixelFate>& fates, const SensorSettings& settings) {
  if (count_.width() != camera.width_px || count_.height() != camera.height_px) {
    count_.resize(camera.width_px, camera.height_px, 0);
    least_m_.resize(camera.width_px, camera.height_px, kNoDepth);
  }
  // Readings in front of environment may be learned, so it must not cover them.
  links_ = robot;
  take_out_environment(links_);
  self_filter(camera, sensor_depth_m, links_, clearance(settings.background_clearance_m),
              workspace_, far_from_robot_);
  tbb::parallel_for(0, camera.height_px, [&](int v) {
    for (int u = 0; u < camera.width_px; ++u) {
      const bool is_reading =
          fates(u, v) == PixelFate::obstacle || fates(u, v) == PixelFate::averaged;
      if (!is_reading || far_from_robot_.fate(u, v) != PixelFate::obstacle) continue;
      const float z = sensor_depth_m(u, v);
      float& least_m = least_m_(u, v);
      const float noise_m = grown_with_depth(static_cast<float>(settings.noise_m), z);
      const bool agrees = std::abs(z - least_m) <= noise_m;
      least_m = agrees ? std::min(z, least_m) : z;
      count_(u, v) = agrees ? std::min(count_(u, v) + 1, settings.background_frames) : 1;
    }
  });
}

void Background::assign(DepthView depth_m, const SensorSettings& settings) {
  count_.resize(depth_m.width, depth_m.height, 0);
  least_m_.resize(depth_m.width, depth_m.height, kNoDepth);
  for (int v = 0; v < depth_m.height; ++v) {
    for (int u = 0; u < depth_m.width; ++u) {
      least_m_(u, v) = depth_m(u, v);
      count_(u, v) = std::isnan(depth_m(u, v)) ? 0 : settings.background_frames;
    }
  }
}

DepthImage Background::learned_m(const Camera& camera, const SensorSettings& settings) const {
  DepthImage out(camera.width_px, camera.height_px, kNoDepth);
  if (count_.width() != out.width() || count_.height() != out.height()) return out;
  for (int v = 0; v < out.height(); ++v) {
    for (int u = 0; u < out.width(); ++u) out(u, v) = depth_m(u, v, settings);
  }
  return out;
}

void Background::complete(DepthView sensor_depth_m, const SensorSettings& settings,
                          ObstacleImage& out) const {
  if (count_.width() != out.fate.width() || count_.height() != out.fate.height()) return;
  tbb::parallel_for(0, out.fate.height(), [&](int v) {
    for (int u = 0; u < out.fate.width(); ++u) {
      PixelFate& fate = out.fate(u, v);
      if (is_kept(fate) || fate == PixelFate::environment || fate == PixelFate::outside_region) {
        continue;
      }
      const float background_m = depth_m(u, v, settings);
      if (std::isnan(background_m)) continue;
      const float noise_m = grown_with_depth(static_cast<float>(settings.noise_m), background_m);
      if (sensor_depth_m(u, v) > background_m + noise_m) continue;
      out.depth_m(u, v) = background_m;
      fate = PixelFate::background;
    }
  });
}

}  // namespace berth
