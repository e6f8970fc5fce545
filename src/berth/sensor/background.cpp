#include "berth/sensor/background.hpp"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

namespace berth {

const Image<PixelFate>& find_beside_robot(const Camera& camera, DepthView depth_m,
                                          const RobotImage& robot, double clearance_m,
                                          BesideRobotWorkspace& workspace) {
  SelfFilterSettings settings;
  settings.tolerance_m = settings.padding_depth_m = 1e6;  // all depths
  settings.padding_m = clearance_m;
  settings.surface_tolerance_m = 0;
  settings.flying_patch_radius_m = 0;
  workspace.links = robot;
  // Things before environment are to be found, so it must not cover anything.
  take_out_environment(workspace.links);
  self_filter(camera, depth_m, workspace.links, settings, workspace.filter, workspace.left);
  return workspace.left.fate;
}

namespace {

/// What `at_1m_m` is at depth z: a depth camera's steps and noise grow with z^2, and not below 1 m.
float grown_with_depth(float at_1m_m, float z_m) { return at_1m_m * std::max(1.0F, z_m * z_m); }

/// Whether the camera read the empty cell there, and not the robot or what the filter drops.
bool shows_cell(PixelFate fate) {
  return fate == PixelFate::obstacle || fate == PixelFate::environment;
}

bool is_environment(const KnownPlace& place, int u, int v, float depth_m) {
  return place.environment_m.width > 0 &&
         depth_m >= place.tolerance.least_reading_m(place.environment_m(u, v));
}

}  // namespace

void Background::learn(const Camera& camera, DepthView sensor_depth_m, const RobotImage& robot,
                       const Image<PixelFate>& fates, const SensorSettings& settings) {
  if (!is_of(camera.width_px, camera.height_px)) {
    count_.resize(camera.width_px, camera.height_px, 0);
    read_count_.resize(camera.width_px, camera.height_px, 0);
    lost_count_.resize(camera.width_px, camera.height_px, 0);
    // Any depth, since the robot covers all.
    anywhere_m_.resize(camera.width_px, camera.height_px, 1);
    least_m_.resize(camera.width_px, camera.height_px, kNoDepth);
  }
  const auto for_pixels_beside = [&](DepthView depth_m, double clearance_m, const auto& action) {
    const Image<PixelFate>& beside =
        find_beside_robot(camera, depth_m, robot, clearance_m, workspace_);
    tbb::parallel_for(0, camera.height_px, [&](int v) {
      for (int u = 0; u < camera.width_px; ++u) {
        if (beside(u, v) == PixelFate::obstacle) action(u, v);
      }
    });
  };
  for_pixels_beside(anywhere_m_, kRobotShadow_m, [&](int u, int v) {
    ++(std::isnan(sensor_depth_m(u, v)) ? lost_count_ : read_count_)(u, v);
  });
  for_pixels_beside(sensor_depth_m, settings.background_clearance_m, [&](int u, int v) {
    if (shows_cell(fates(u, v))) learn_pixel(u, v, sensor_depth_m(u, v), settings);
  });
}

void Background::learn_pixel(int u, int v, float z_m, const SensorSettings& settings) {
  float& least_m = least_m_(u, v);
  const float noise_m = grown_with_depth(static_cast<float>(settings.noise_m), z_m);
  const bool agrees = std::abs(z_m - least_m) <= noise_m;
  least_m = agrees ? std::min(z_m, least_m) : z_m;
  count_(u, v) = agrees ? std::min(count_(u, v) + 1, settings.background_frames) : 1;
}

void Background::assign(DepthView depth_m, const SensorSettings& settings) {
  count_.resize(depth_m.width, depth_m.height, 0);
  read_count_.resize(depth_m.width, depth_m.height, 0);
  lost_count_.resize(depth_m.width, depth_m.height, 0);
  anywhere_m_.resize(depth_m.width, depth_m.height, 1);
  least_m_.resize(depth_m.width, depth_m.height, kNoDepth);
  for (int v = 0; v < depth_m.height; ++v) {
    for (int u = 0; u < depth_m.width; ++u) {
      least_m_(u, v) = depth_m(u, v);
      count_(u, v) = std::isfinite(depth_m(u, v)) ? settings.background_frames : 0;
      read_count_(u, v) = std::isnan(depth_m(u, v)) ? 0 : settings.background_frames;
    }
  }
}

DepthImage Background::learned_m(const Camera& camera, const SensorSettings& settings) const {
  DepthImage out(camera.width_px, camera.height_px, kNoDepth);
  if (!is_of(out.width(), out.height())) return out;
  for (int v = 0; v < out.height(); ++v) {
    for (int u = 0; u < out.width(); ++u) out(u, v) = depth_m(u, v, settings);
  }
  return out;
}

void Background::complete(DepthView sensor_depth_m, const KnownPlace& place,
                          const SensorSettings& settings, ObstacleImage& out) const {
  if (!is_of(out.fate.width(), out.fate.height())) return;
  tbb::parallel_for(0, out.fate.height(), [&](int v) {
    for (int u = 0; u < out.fate.width(); ++u) {
      PixelFate& fate = out.fate(u, v);
      if (is_kept(fate) || fate == PixelFate::environment || fate == PixelFate::outside_region) {
        continue;
      }
      const float background_m = depth_m(u, v, settings);
      if (!std::isfinite(background_m)) continue;
      const float noise_m = grown_with_depth(static_cast<float>(settings.noise_m), background_m);
      if (sensor_depth_m(u, v) > background_m + noise_m) continue;
      if (is_environment(place, u, v, background_m)) continue;
      out.depth_m(u, v) = background_m;
      fate = PixelFate::background;
    }
  });
}

}  // namespace berth
