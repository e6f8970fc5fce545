#include "sim/random_images.hpp"

#include <algorithm>
#include <cmath>

#include "sim/random.hpp"

namespace berth::sim {
namespace {

Camera random_camera(Random& random, int width, int height) {
  Camera camera{width, height};
  camera.fx_px = width * random(0.5, 1.3);
  camera.fy_px = camera.fx_px * random(0.9, 1.1);
  const bool outside = random.chance(0.1);
  camera.cx_px = width * (outside ? random(-0.5, 1.5) : random(0.4, 0.6));
  camera.cy_px = height * (outside ? random(-0.5, 1.5) : random(0.4, 0.6));
  return camera;
}

void put_nearer(float depth_m, float& pixel_m) {
  if (!(pixel_m <= depth_m)) pixel_m = depth_m;
}

void draw_plane(Random& random, DepthImage& depth_m) {
  const double z_m = random(1.5, 6);
  const double slope_u = random(-0.4, 0.4) * z_m / depth_m.width();
  const double slope_v = random(-0.4, 0.4) * z_m / depth_m.height();
  for (int v = 0; v < depth_m.height(); ++v) {
    for (int u = 0; u < depth_m.width(); ++u) {
      depth_m(u, v) = static_cast<float>(z_m + slope_u * u + slope_v * v);
    }
  }
}

void draw_ball(Random& random, DepthImage& depth_m) {
  const double radius_px = depth_m.width() * random(0.01, 0.12);
  const double u0 = random(0, depth_m.width());
  const double v0 = random(0, depth_m.height());
  const double z_m = random(0.4, 3.5);
  const double bulge_m = random(0.02, 0.3);
  for (int v = 0; v < depth_m.height(); ++v) {
    for (int u = 0; u < depth_m.width(); ++u) {
      const double r = std::hypot(u - u0, v - v0) / radius_px;
      if (r >= 1) continue;
      put_nearer(static_cast<float>(z_m - bulge_m * std::sqrt(1 - r * r)), depth_m(u, v));
    }
  }
}

void draw_box(Random& random, DepthImage& depth_m) {
  const int u_begin = static_cast<int>(random(0, depth_m.width()));
  const int v_begin = static_cast<int>(random(0, depth_m.height()));
  const int u_end =
      std::min<int>(depth_m.width(), u_begin + random(0.01, 0.2) * depth_m.width() + 1);
  const int v_end =
      std::min<int>(depth_m.height(), v_begin + random(0.01, 0.2) * depth_m.height() + 1);
  const auto z_m = static_cast<float>(random(0.4, 3.5));
  for (int v = v_begin; v < v_end; ++v) {
    for (int u = u_begin; u < u_end; ++u) put_nearer(z_m, depth_m(u, v));
  }
}

void spoil(Random& random, DepthImage& depth_m) {
  const double noise_m = random(0, 0.004);
  const double dropouts = random(0, 0.1);
  for (float& pixel_m : depth_m.pixels()) {
    pixel_m += static_cast<float>(noise_m * random(-1, 1) * pixel_m * pixel_m);
    if (random.chance(dropouts)) pixel_m = kNoDepth;
  }
}

struct Joint {
  double u;
  double v;
  double z_m;
};

/// A strip between two joints with a round cross section.
void draw_link(Joint a, Joint b, double radius_px, LinkId id, RobotImage& robot) {
  const double du = b.u - a.u;
  const double dv = b.v - a.v;
  const double squared = std::max(1.0, du * du + dv * dv);
  for (int v = 0; v < robot.depth_m.height(); ++v) {
    for (int u = 0; u < robot.depth_m.width(); ++u) {
      const double s = std::clamp(((u - a.u) * du + (v - a.v) * dv) / squared, 0.0, 1.0);
      const double r = std::hypot(u - a.u - s * du, v - a.v - s * dv) / radius_px;
      if (r > 1) continue;
      const auto z_m =
          static_cast<float>(a.z_m + s * (b.z_m - a.z_m) - 0.06 * std::sqrt(1 - r * r));
      if (robot.depth_m(u, v) <= z_m) continue;
      robot.depth_m(u, v) = z_m;
      robot.link_id(u, v) = id;
    }
  }
}

void draw_robot(Random& random, int link_count, RobotImage& robot) {
  const double width = robot.depth_m.width();
  const double height = robot.depth_m.height();
  const double length_px = 1.1 * width / link_count;
  Joint joint{random(0.2, 0.8) * width, random(0.2, 0.8) * height, random(0.7, 2)};
  for (int i = 0; i < link_count; ++i) {
    const double angle = random(0, 6.283);
    const Joint next{std::clamp(joint.u + length_px * std::cos(angle), 0.0, width),
                     std::clamp(joint.v + length_px * std::sin(angle), 0.0, height),
                     std::max(0.3, joint.z_m + random(-0.2, 0.2))};
    draw_link(joint, next, 0.028 * width + 0.6, static_cast<LinkId>(i + 1), robot);
    joint = next;
  }
}

/// What the self filter does: the robot and what lies behind it has no obstacle reading.
void cut_out_robot(const RobotImage& robot, DepthImage& depth_m) {
  for (std::size_t i = 0; i < depth_m.pixels().size(); ++i) {
    if (depth_m.pixels()[i] >= robot.depth_m.pixels()[i] - 0.04f) depth_m.pixels()[i] = kNoDepth;
  }
}

}  // namespace

ImagePair empty_images(int width, int height, int link_count) {
  ImagePair images;
  images.camera = {width, height, 0.9 * width, 0.9 * width, 0.5 * (width - 1), 0.5 * (height - 1)};
  images.robot.depth_m = DepthImage(width, height, kNoDepth);
  images.robot.link_id = Image<LinkId>(width, height, kNoLink);
  images.obstacle_depth_m = DepthImage(width, height, kNoDepth);
  images.link_count = link_count;
  return images;
}

ImagePair random_images(std::uint32_t seed, int width, int height, int link_count) {
  Random random(seed);
  ImagePair images = empty_images(width, height, link_count);
  images.camera = random_camera(random, width, height);
  if (random.chance(0.9)) draw_plane(random, images.obstacle_depth_m);
  const int things = static_cast<int>(random(0, 10));
  for (int i = 0; i < things; ++i) {
    draw_ball(random, images.obstacle_depth_m);
    draw_box(random, images.obstacle_depth_m);
  }
  spoil(random, images.obstacle_depth_m);
  draw_robot(random, link_count, images.robot);
  cut_out_robot(images.robot, images.obstacle_depth_m);
  return images;
}

}  // namespace berth::sim
