#include "mesh_case.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "sim/sensor_model.hpp"

namespace berth::sim {
namespace {

constexpr std::array<std::pair<int, int>, 3> kSizes_px = {{{160, 120}, {240, 160}, {320, 240}}};

void set_fate(DrawnView& view, int u, int v, PixelFate fate, float depth_m) {
  --view.obstacles.count[static_cast<std::size_t>(view.obstacles.fate(u, v))];
  ++view.obstacles.count[static_cast<std::size_t>(fate)];
  view.obstacles.fate(u, v) = fate;
  view.obstacles.depth_m(u, v) = depth_m;
}

/// What F has where a pixel gets this fate.
float depth_of(Random& random, PixelFate fate, float sensed_m) {
  switch (fate) {
    case PixelFate::obstacle:
      return sensed_m;
      return sensed_m * static_cast<float>(random(0.9, 1));
    case PixelFate::background:
    case PixelFate::hole:
      return static_cast<float>(random(0.5, 3));
    default:
      return kNoDepth;
  }
}

/// A fate that a pixel with, or without, a reading may have.
PixelFate draw_fate(Random& random, bool has_reading) {
  if (!has_reading) {
    constexpr std::array kFates = {PixelFate::no_reading, PixelFate::background, PixelFate::hole};
    return kFates[random.whole(0, 2)];
  }
  constexpr std::array kFates = {
      PixelFate::obstacle,       PixelFate::robot,   PixelFate::padding,   PixelFate::flying_patch,
      PixelFate::outside_region, PixelFate::speckle, PixelFate::background};
  return kFates[random.whole(0, static_cast<int>(kFates.size()) - 1)];
}

/// Blobs of pixels get another fate.
void change_fates(Random& random, DrawnView& view) {
  const int blobs = random.whole(1, 30);
  for (int i = 0; i < blobs; ++i) {
    const int u = random.whole(0, view.camera.width_px - 1);
    const int v = random.whole(0, view.camera.height_px - 1);
    const PixelRect blob = clip({u, v, u + random.whole(1, 12), v + random.whole(1, 12)},
                                view.camera.width_px, view.camera.height_px);
    const bool has_reading = random.chance(0.7);
    const PixelFate fate = draw_fate(random, has_reading);
    for (int y = blob.v_begin; y < blob.v_end; ++y) {
      for (int x = blob.u_begin; x < blob.u_end; ++x) {
        if (has_reading && std::isnan(view.depth_m(x, y))) continue;
        if (!has_reading) view.depth_m(x, y) = kNoDepth;
        set_fate(view, x, y, fate, depth_of(random, fate, view.depth_m(x, y)));
      }
    }
  }
}

/// S changes; F and the fates follow.
void disturb_sensor(Random& random, std::uint32_t seed, DrawnView& view) {
  if (random.chance(0.5)) add_noise(random(0.001, 0.005), seed, view.depth_m);
  if (random.chance(0.5)) drop_out(random(0.001, 0.2), seed + 1, view.depth_m);
  for (int v = 0; v < view.camera.height_px; ++v) {
    for (int u = 0; u < view.camera.width_px; ++u) {
      const float sensed_m = view.depth_m(u, v);
      if (std::isnan(sensed_m)) {
        set_fate(view, u, v, PixelFate::no_reading, kNoDepth);
      } else if (is_kept(view.obstacles.fate(u, v))) {
        view.obstacles.depth_m(u, v) = sensed_m;
      }
    }
  }
}

SpaceSettings draw_settings(Random& random) {
  SpaceSettings settings;
  settings.surface_thickness_m = std::pow(10, random(-3, -0.5));
  settings.free_space_margin_m = random.chance(0.2) ? 0 : random(0, 0.1);
  settings.behind_robot_m = random.chance(0.2) ? 0 : random(0, 0.6);
  if (random.chance(0.3)) settings.no_reading = NoReading::free;
  settings.obstacle_speed_m_s = random(0, 3);
  if (random.chance(0.2)) settings.unobserved = Unobserved::unknown;
  return settings;
}

}  // namespace

MeshCase plain_mesh_case(const DrawnViews& drawn) { return {drawn.views, drawn.scene.pose, {}}; }

MeshCase draw_mesh_case(const RobotModel& model, const std::vector<MeshTree>& link_trees,
                        std::uint32_t seed) {
  Random random(seed + 0x51ed270bU);
  const auto [width_px, height_px] = kSizes_px[random.whole(0, 2)];
  DrawnSceneSettings scene{.width_px = width_px, .height_px = height_px};
  scene.has_room = random.chance(0.7);
  const DrawnViews drawn = draw_views(model, link_trees, scene, seed, random.whole(1, 4));
  MeshCase drawn_case = plain_mesh_case(drawn);
  if (random.chance(0.3)) return drawn_case;
  for (std::size_t k = 0; k < drawn_case.views.size(); ++k) {
    DrawnView& view = drawn_case.views[k];
    if (random.chance(0.4)) disturb_sensor(random, seed + static_cast<std::uint32_t>(k), view);
    if (random.chance(0.4)) change_fates(random, view);
    if (random.chance(0.2)) view.X_BC = miscalibrated(view.X_BC, 0.01, 0.005, seed);
    if (k > 0 && random.chance(0.3)) view.age_s = random(0, 0.25);
  }
  if (random.chance(0.5)) drawn_case.settings = draw_settings(random);
  if (random.chance(0.5)) {
    const JointState moved = delayed(model, drawn.scene.joints, random(0.01, 0.5), 1, seed);
    forward_kinematics(model, moved.position, drawn_case.pose);
  }
  return drawn_case;
}

}  // namespace berth::sim
