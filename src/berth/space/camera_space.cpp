#include "berth/space/camera_space.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstring>

#include "berth/space/closed_free_depth.hpp"
#include "berth/space/free_depth.hpp"

namespace berth {

double detection_capability_m(const SpaceSettings& settings, const Camera& camera) {
  constexpr double kFar_m = 3, kLeast_m = 0.04;
  if (settings.detection_capability_m) return *settings.detection_capability_m;
  const double focal_px = std::min(camera.fx_px, camera.fy_px);
  const double told_m = 2 * kClosingTiers.back().least_radius_px() * kFar_m / focal_px;
  return std::max(kLeast_m, std::round(100 * told_m) / 100);
}

void validate(const SpaceSettings& settings) {
  const SettingCheck check{"space"};
  visit_settings(settings, check);
  check({"obstacle_speed_m_s", kNotNegative, ""}, settings.obstacle_speed_m_s);
}

namespace {

/// For a camera that stands, once.
void build_environment_front(const EnvironmentSurfaces& environment, CameraSpace& out) {
  out.has_environment = environment.front_m.width > 0;
  const bool is_same =
      environment.serial_number != 0 && environment.serial_number == out.environment_number;
  if (!out.has_environment || is_same) return;
  build_environment_ceiling(environment.front_m, out.front_to_end, out.environment_front);
  out.environment_number = environment.serial_number;
}

}  // namespace

void build_camera_space(const Camera& camera, DepthView sensor_depth_m,
                        const ObstacleImage& obstacles, const EnvironmentSurfaces& environment,
                        const SpaceSettings& settings, CameraSpace& out) {
  assert(sensor_depth_m.width == camera.width_px && sensor_depth_m.height == camera.height_px);
  build_reading_space(camera, obstacles.depth_m, settings, out);
  if (out.is_empty()) return;
  find_own_free_depth(sensor_depth_m, obstacles, environment.back_m, settings, out.sensor_depth,
                      out.hidden_depth, out.own_free_depth);
  const double told_m = detection_capability_m(settings, camera);
  free_holes_beside_robot(camera, sensor_depth_m, obstacles, told_m, out.robot_holes,
                          out.own_free_depth);
  close_free_depth(camera, told_m, out.closing, out.own_free_depth);
  find_free_depth(out.own_free_depth, out.free_depth);
  hide_behind_holes(obstacles, out.own_free_depth, told_m, settings, out.hidden_depth);
  build_depth_windows(out.hidden_depth);
  build_depth_windows(out.free_depth);
  build_environment_front(environment, out);
  out.hides_without_reading =
      obstacles.count_of(PixelFate::flying_patch) > 0 || obstacles.count_of(PixelFate::hole) > 0;
  out.has_free_depth = true;
}

void build_reading_space(const Camera& camera, DepthView obstacle_depth_m,
                         const SpaceSettings& settings, CameraSpace& out) {
  validate(settings);
  assert(obstacle_depth_m.width == camera.width_px && obstacle_depth_m.height == camera.height_px);
  out.camera = camera;
  out.settings = settings;
  out.obstacle_depth_m = obstacle_depth_m;
  out.has_free_depth = out.has_environment = out.hides_without_reading = false;
  if (!out.is_empty()) build_depth_cells(obstacle_depth_m, out.cells);
}

void hide_behind_holes(const ObstacleImage& obstacles, const UnitImage& own, double detected_m,
                       const SpaceSettings& settings, DepthWindows& hidden) {
  const int behind = units_of(static_cast<float>(detected_m / 2 + settings.free_space_margin_m +
                                                 settings.surface_thickness_m));
  for (int v = 0; v < own.height(); ++v) {
    const PixelFate* const fate = obstacles.fate.row(v);
    constexpr auto kHole = static_cast<int>(PixelFate::hole);
    // Most rows have none.
    if (std::memchr(fate, kHole, static_cast<std::size_t>(own.width())) == nullptr) continue;
    const DepthUnits* const frees = own.row(v);
    DepthUnits* const from = hidden.levels[0].row(v);
    for (int u = 0; u < own.width(); ++u) {
      if (fate[u] != PixelFate::hole) continue;
      const int hides = std::min<int>(frees[u] + behind, kEndlessUnits);
      from[u] = std::min(from[u], static_cast<DepthUnits>(hides));
    }
  }
}

void build_environment_ceiling(DepthView environment_front_m, UnitImage& scratch,
                               DepthCeiling& out) {
  set_size(environment_front_m.width, environment_front_m.height, scratch);
  for (int v = 0; v < environment_front_m.height; ++v) {
    for (int u = 0; u < environment_front_m.width; ++u) {
      const float front_m = environment_front_m(u, v);
      scratch(u, v) = std::isnan(front_m)
                          ? DepthUnits{0}
                          : static_cast<DepthUnits>(kEndlessUnits - units_up(front_m));
    }
  }
  // The least of 3 x 3, and nothing in the outermost ring, as of what is free.
  find_free_depth(scratch, out.left);
  build_depth_windows(out.left);
}

}  // namespace berth
