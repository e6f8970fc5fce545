#include "berth/self_filter/self_filter.hpp"

#include <cassert>

#include "berth/self_filter/edges.hpp"
#include "berth/self_filter/rows.hpp"

namespace berth {
namespace {

void classify(DepthView sensor_depth_m, const RobotImage& robot, const GrownRobot& grown,
              const SelfFilterSettings& settings, Image<PixelFate>& fate) {
  const Tolerance tolerance = tolerance_of(settings);
  // Where nothing is dilated, the padding says no more a second time.
  const Image<float>& dilated_depth_m =
      settings.dilation_px > 0 ? grown.dilated_depth_m : grown.padded_depth_m;
  for (int v = 0; v < fate.height(); ++v) {
    classify_row({sensor_depth_m.row(v), robot.depth_m.row(v), robot.link_id.row(v),
                  grown.padded_depth_m.row(v), dilated_depth_m.row(v), fate.width()},
                 tolerance, fate.row(v));
  }
}

void keep_obstacles(DepthView sensor_depth_m, ObstacleImage& out) {
  out.count.fill(0);
  for (int v = 0; v < sensor_depth_m.height; ++v) {
    keep_obstacle_row(sensor_depth_m.row(v), out.fate.row(v), sensor_depth_m.width,
                      out.depth_m.row(v), out.count);
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
