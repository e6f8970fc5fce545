#include "lab/bench/hard_images.hpp"

#include <algorithm>
#include <cmath>
#include <random>

namespace berth::lab {
namespace {

using sim::empty_images;
using sim::ImagePair;
using sim::random_images;

constexpr int kHardLinks = 8;

/// The direction (x, y, 1) through a pixel's centre.
struct Ray {
  double x;
  double y;
};

Ray ray_through(const Camera& camera, int u, int v) {
  return {(u - camera.cx_px) / camera.fx_px, (v - camera.cy_px) / camera.fy_px};
}

template <class Draw>
void for_each_pixel(const ImagePair& images, Draw draw) {
  for (int v = 0; v < images.camera.height_px; ++v) {
    for (int u = 0; u < images.camera.width_px; ++u) draw(u, v);
  }
}

/// The links stand side by side as columns from u_begin on, width_px for all.
void put_robot(ImagePair& images, int u, int v, double depth_m, double u_begin, double width_px) {
  const int column = static_cast<int>((u - u_begin) / width_px * kHardLinks);
  images.robot.depth_m(u, v) = static_cast<float>(depth_m);
  images.robot.link_id(u, v) = static_cast<LinkId>(1 + std::clamp(column, 0, kHardLinks - 1));
}

/// Depth of a sphere around (0, 0, centre_m), near (-1) or far (+1) side; NaN beside it.
double sphere_depth_m(Ray ray, double centre_m, double radius_m, int side) {
  const double a = ray.x * ray.x + ray.y * ray.y + 1;
  const double root = centre_m * centre_m - a * (centre_m * centre_m - radius_m * radius_m);
  return (centre_m + side * std::sqrt(root)) / a;
}

ImagePair sphere_images(double gap_m, int side, int width, int height) {
  constexpr double kCentre_m = 1.5;
  // Its outline holds about 8 % of the image's pixels.
  constexpr double kRadius_m = 0.227;
  ImagePair images = empty_images(width, height, kHardLinks);
  const double radius_px = images.camera.fx_px * kRadius_m / kCentre_m;
  for_each_pixel(images, [&](int u, int v) {
    const Ray ray = ray_through(images.camera, u, v);
    images.obstacle_depth_m(u, v) =
        static_cast<float>(sphere_depth_m(ray, kCentre_m, kRadius_m + gap_m, +1));
    const double ball_m = sphere_depth_m(ray, kCentre_m, kRadius_m, side);
    if (std::isnan(ball_m)) return;
    put_robot(images, u, v, ball_m, images.camera.cx_px - radius_px, 2 * radius_px);
  });
  return images;
}

}  // namespace

ImagePair contact_images(std::uint32_t seed, int width, int height) {
  ImagePair images = random_images(seed, width, height, kHardLinks);
  std::array<bool, kHardLinks + 1> touched{};
  touched[kNoLink] = true;
  for_each_pixel(images, [&](int u, int v) {
    const LinkId id = images.robot.link_id(u, v);
    if (touched[id]) return;
    touched[id] = true;
    images.obstacle_depth_m(u, v) = images.robot.depth_m(u, v);
  });
  return images;
}

ImagePair noise_images(std::uint32_t seed, int width, int height) {
  ImagePair images = random_images(seed, width, height, kHardLinks);
  std::mt19937 engine(seed);
  for (float& depth_m : images.obstacle_depth_m.pixels()) {
    depth_m = 0.4f + 2.6f * static_cast<float>(engine()) / 4294967296.0f;
  }
  for_each_pixel(images, [&](int u, int v) {
    if (images.robot.link_id(u, v) != kNoLink) images.obstacle_depth_m(u, v) = kNoDepth;
  });
  return images;
}

ImagePair checkerboard_images(int cell_px, int width, int height) {
  ImagePair images = empty_images(width, height, kHardLinks);
  const int u_begin = 3 * width / 10;
  const int u_end = 7 * width / 10;
  for_each_pixel(images, [&](int u, int v) {
    if (u < u_begin || u >= u_end || v < 3 * height / 10 || v >= 7 * height / 10) return;
    if ((u / cell_px + v / cell_px) % 2 == 0) {
      put_robot(images, u, v, 1.0, u_begin, u_end - u_begin);
    } else {
      images.obstacle_depth_m(u, v) = 1.2f + 0.001f * static_cast<float>((u * v) % 17);
    }
  });
  return images;
}

ImagePair plate_images(double tilt_rad, int width, int height) {
  constexpr double kPlate_m = 1.2;
  constexpr double kGap_m = 0.3;
  ImagePair images = empty_images(width, height, kHardLinks);
  const double u_begin = 0.36 * width;
  const double u_end = 0.64 * width;
  for_each_pixel(images, [&](int u, int v) {
    // Depth of the plane through (0, 0, 1) with normal (sin, 0, cos); beyond 90 degrees none.
    const double cosine =
        std::cos(tilt_rad) + std::sin(tilt_rad) * ray_through(images.camera, u, v).x;
    if (cosine <= 0) return;
    const double scale = std::cos(tilt_rad) / cosine;
    const double behind_m = kPlate_m + kGap_m / std::cos(tilt_rad);
    images.obstacle_depth_m(u, v) = static_cast<float>(behind_m * scale);
    if (u < u_begin || u >= u_end || v < 0.36 * height || v >= 0.64 * height) return;
    put_robot(images, u, v, kPlate_m * scale, u_begin, u_end - u_begin);
  });
  return images;
}

ImagePair ball_images(double gap_m, int width, int height) {
  return sphere_images(gap_m, -1, width, height);
}

}  // namespace berth::lab
