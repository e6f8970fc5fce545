#include "tests/self_filter/flat_scene.hpp"

namespace berth {
namespace {

template <typename T>
void fill(Image<T>& image, const PixelRect& pixels, T value) {
  for (int v = pixels.v_begin; v < pixels.v_end; ++v) {
    for (int u = pixels.u_begin; u < pixels.u_end; ++u) image(u, v) = value;
  }
}

}  // namespace

Camera flat_camera() { return {kSide_px, kSide_px, 100, 100, 30, 30}; }

FlatScene::FlatScene()
    : robot{DepthImage(kSide_px, kSide_px, kNoDepth), Image<LinkId>(kSide_px, kSide_px, kNoLink)},
      sensor_depth_m(kSide_px, kSide_px, kWall_m) {}

void FlatScene::add_link(LinkId id, const PixelRect& pixels, float depth_m) {
  fill(robot.depth_m, pixels, depth_m);
  fill(robot.link_id, pixels, id);
}

void FlatScene::see(const PixelRect& pixels, float depth_m) {
  fill(sensor_depth_m, pixels, depth_m);
}

SelfFilterSettings no_rules() {
  SelfFilterSettings settings;
  settings.tolerance_m = 0;
  settings.padding_m = 0;
  settings.padding_depth_m = 100;
  settings.surface_tolerance_m = 0;
  settings.flying_patch_radius_m = 0;
  return settings;
}

ObstacleImage filter(const FlatScene& scene, const SelfFilterSettings& settings) {
  SelfFilterWorkspace workspace;
  ObstacleImage out;
  self_filter(flat_camera(), scene.sensor_depth_m, scene.robot, settings, workspace, out);
  return out;
}

}  // namespace berth
