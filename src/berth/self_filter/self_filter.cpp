#include "berth/self_filter/self_filter.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "berth/self_filter/edges.hpp"

namespace berth {
namespace {

double tolerance_at(const SelfFilterSettings& s, double z) {
  return s.tolerance_m + s.tolerance_per_m * z + s.tolerance_per_m2 * z * z;
}

/// On the surface of depth `model`, or behind it.
bool belongs_to(double reading, double model, const SelfFilterSettings& settings) {
  return reading >= model - tolerance_at(settings, model);
}

PixelFate fate_of(float reading, LinkId id, float model, float padded, float dilated,
                  const SelfFilterSettings& settings) {
  if (std::isnan(reading)) return PixelFate::no_reading;
  if (id != kNoLink && belongs_to(reading, model, settings)) {
    return id == kEnvironmentLink ? PixelFate::environment : PixelFate::robot;
  }
  if (belongs_to(reading, padded, settings)) return PixelFate::padding;
  if (belongs_to(reading, dilated, settings)) return PixelFate::dilation;
  return PixelFate::obstacle;
}

void classify(DepthView sensor_depth_m, const RobotImage& robot, const GrownRobot& grown,
              const SelfFilterSettings& settings, Image<PixelFate>& fate) {
  for (int v = 0; v < fate.height(); ++v) {
    for (int u = 0; u < fate.width(); ++u) {
      fate(u, v) = fate_of(sensor_depth_m(u, v), robot.link_id(u, v), robot.depth_m(u, v),
                           grown.padded_depth_m(u, v), grown.dilated_depth_m(u, v), settings);
    }
  }
}

void keep_obstacles(DepthView sensor_depth_m, ObstacleImage& out) {
  out.count.fill(0);
  for (int v = 0; v < sensor_depth_m.height; ++v) {
    const float* readings = sensor_depth_m.row(v);
    const PixelFate* fate = out.fate.row(v);
    float* depth_m = out.depth_m.row(v);
    for (int u = 0; u < sensor_depth_m.width; ++u) {
      depth_m[u] = fate[u] == PixelFate::obstacle ? readings[u] : kNoDepth;
      ++out.count[static_cast<std::size_t>(fate[u])];
    }
  }
}

}  // namespace

void self_filter(const Camera& camera, DepthView sensor_depth_m, const RobotImage& robot,
                 const SelfFilterSettings& settings, SelfFilterWorkspace& workspace,
                 ObstacleImage& out) {
  assert(sensor_depth_m.width == camera.width_px && sensor_depth_m.height == camera.height_px);
  assert(robot.link_id.width() == camera.width_px && robot.link_id.height() == camera.height_px);
  out.depth_m.resize(camera.width_px, camera.height_px, kNoDepth);
  out.fate.resize(camera.width_px, camera.height_px, PixelFate::obstacle);

  grow_robot(camera, robot, settings, workspace.grown);
  classify(sensor_depth_m, robot, workspace.grown, settings, out.fate);
  if (settings.edge_jump_m > 0) {
    mark_mixed_pixels(sensor_depth_m, static_cast<float>(settings.edge_jump_m), out.fate);
  }
  if (settings.island_radius_m > 0) {
    mark_islands(camera, sensor_depth_m, robot, settings, workspace.islands, out.fate);
  }
  keep_obstacles(sensor_depth_m, out);
}

}  // namespace berth
