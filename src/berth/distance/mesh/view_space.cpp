#include "berth/distance/mesh/view_space.hpp"

#include <algorithm>
#include <cassert>

namespace berth {
namespace {

void copy(DepthView from, DepthImage& to) {
  if (to.width() != from.width || to.height() != from.height) {
    to.resize(from.width, from.height, kNoDepth);
  }
  for (int v = 0; v < from.height; ++v) std::copy_n(from.row(v), from.width, to.row(v));
}

}  // namespace

void build_view_space(const Camera& camera, DepthView sensor_depth_m,
                      const ObstacleImage& obstacles, const SpaceSettings& settings,
                      ViewSpace& out) {
  validate(settings);
  assert(sensor_depth_m.width == camera.width_px && sensor_depth_m.height == camera.height_px);
  assert(obstacles.depth_m.width() == camera.width_px &&
         obstacles.depth_m.height() == camera.height_px);
  out.camera = camera;
  out.settings = settings;
  copy(sensor_depth_m, out.sensor_depth_m);
  copy(obstacles.depth_m, out.obstacle_depth_m);
  find_own_free_depth(sensor_depth_m, obstacles, settings, out.own_free_depth_m);
  find_free_depth(out.own_free_depth_m, out.free_depth_m);
  if (out.is_empty()) return;
  build_depth_cells(out.obstacle_depth_m, out.cells);
  build_depth_windows(out.obstacle_depth_m, out.obstacle_windows);
  build_depth_windows(out.free_depth_m, out.free_windows);
}

}  // namespace berth
