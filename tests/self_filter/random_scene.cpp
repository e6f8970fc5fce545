#include "tests/self_filter/random_scene.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "sim/random.hpp"

namespace berth {
namespace {

using sim::Random;

/// 0 now and then.
double random_setting(Random& random, double low, double high) {
  return random.chance(0.15) ? 0 : random(low, high);
}

SelfFilterSettings random_settings(Random& random) {
  SelfFilterSettings settings;
  settings.tolerance_m = random_setting(random, 0.01, 0.08);
  settings.tolerance_per_m2 = random.chance(0.3) ? random(0, 0.03) : 0;
  settings.padding_m = random_setting(random, 0.005, 0.12);
  settings.padding_depth_m = random_setting(random, 0.05, 1.5);
  if (random.chance(0.3)) {
    settings.link_padding_m = {random(0, 0.2), std::numeric_limits<double>::quiet_NaN(), 0.0};
  }
  if (random.chance(0.7)) settings.surface_tolerance_m = random_setting(random, 0.01, 0.04);
  settings.flying_patch_radius_m = random_setting(random, 0.02, 0.4);
  return settings;
}

void add_environment(Random& random, RobotImage& robot) {
  const int width = robot.depth_m.width();
  const int height = robot.depth_m.height();
  const auto depth_m = static_cast<float>(random(0.5, 2.5));
  const int v_begin = random.whole(0, height);
  const int u_begin = random.whole(0, width);
  for (int v = v_begin; v < std::min(height, v_begin + height / 4); ++v) {
    for (int u = u_begin; u < std::min(width, u_begin + width / 3); ++u) {
      if (robot.depth_m(u, v) <= depth_m) continue;
      robot.depth_m(u, v) = depth_m;
      robot.link_id(u, v) = kEnvironmentLink;
    }
  }
}

/// What a displaced robot would show, in front of what stands behind it.
void see_robot(Random& random, const RobotImage& robot, DepthImage& sensor_depth_m) {
  const int du = random.whole(-3, 3);
  const int dv = random.whole(-3, 3);
  const double noise_m = random(0, 0.03);
  for (int v = 0; v < sensor_depth_m.height(); ++v) {
    for (int u = 0; u < sensor_depth_m.width(); ++u) {
      const int from_u = std::clamp(u + du, 0, sensor_depth_m.width() - 1);
      const int from_v = std::clamp(v + dv, 0, sensor_depth_m.height() - 1);
      const float z = robot.depth_m(from_u, from_v) + static_cast<float>(noise_m * random(-1, 1));
      float& reading_m = sensor_depth_m(u, v);
      if (!(reading_m <= z) && !std::isnan(z)) reading_m = z;
    }
  }
}

/// Small patches at about a robot pixel's depth, and larger ones that join it, or between two
/// depths, or holes.
void add_patches(Random& random, const RobotImage& robot, DepthImage& sensor_depth_m) {
  for (int i = random.whole(0, 45); i > 0; --i) {
    const int u0 = random.whole(0, sensor_depth_m.width() - 1);
    const int v0 = random.whole(0, sensor_depth_m.height() - 1);
    const bool is_flying = random.chance(0.5);
    const double farthest_m = is_flying ? 0.02 : 0.15;
    const int longest_px = is_flying ? 20 : 8;
    const float z = robot.depth_m(u0, v0) + static_cast<float>(random(-farthest_m, farthest_m));
    const bool is_hole = random.chance(0.3);
    const int u_begin = std::max(0, u0 - random.whole(0, longest_px));
    const int v_begin = std::max(0, v0 - random.whole(0, longest_px));
    const int u_end = std::min(sensor_depth_m.width(), u_begin + random.whole(1, longest_px));
    const int v_end = std::min(sensor_depth_m.height(), v_begin + random.whole(1, longest_px));
    for (int v = v_begin; v < v_end; ++v) {
      for (int u = u_begin; u < u_end; ++u) {
        if (is_hole) sensor_depth_m(u, v) = kNoDepth;
        if (!is_hole && !std::isnan(z)) sensor_depth_m(u, v) = z;
      }
    }
  }
}

PixelRect tight_extent(const RobotImage& robot) {
  PixelRect extent;
  for (int v = 0; v < robot.link_id.height(); ++v) {
    for (int u = 0; u < robot.link_id.width(); ++u) {
      if (robot.link_id(u, v) != kNoLink) extent = united(extent, {u, v, u + 1, v + 1});
    }
  }
  return extent;
}

}  // namespace

RandomScene random_scene(std::uint32_t seed) {
  Random random(seed);
  const int width = random.whole(1, 150);
  const int height = random.whole(1, 110);
  sim::ImagePair images = sim::random_images(seed, width, height, random.whole(1, 5));
  RandomScene scene{images.camera, images.robot, images.obstacle_depth_m, random_settings(random)};
  if (random.chance(0.4)) add_environment(random, scene.robot);
  if (random.chance(0.05)) {
    scene.robot.depth_m = DepthImage(width, height, kNoDepth);
    scene.robot.link_id = Image<LinkId>(width, height, kNoLink);
  }
  see_robot(random, scene.robot, scene.sensor_depth_m);
  add_patches(random, scene.robot, scene.sensor_depth_m);
  if (random.chance(0.7)) scene.robot.extent = tight_extent(scene.robot);
  return scene;
}

}  // namespace berth
