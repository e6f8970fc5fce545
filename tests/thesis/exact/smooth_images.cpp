#include "tests/thesis/exact/smooth_images.hpp"

#include <algorithm>
#include <cmath>

namespace berth::testing {
namespace {

constexpr int kLinks = 3;

/// Calls depth_of(x, y) for the ray (x, y, 1) of each pixel and sets what it gives.
template <class RobotDepth, class ObstacleDepth>
sim::ImagePair draw(int width, int height, RobotDepth robot_m, ObstacleDepth obstacle_m) {
  sim::ImagePair images = sim::empty_images(width, height, kLinks);
  const Camera& camera = images.camera;
  for (int v = 0; v < height; ++v) {
    for (int u = 0; u < width; ++u) {
      const double x = (u - camera.cx_px) / camera.fx_px;
      const double y = (v - camera.cy_px) / camera.fy_px;
      images.obstacle_depth_m(u, v) = static_cast<float>(obstacle_m(x, y));
      const double depth_m = robot_m(x, y);
      if (std::isnan(depth_m)) continue;
      images.robot.depth_m(u, v) = static_cast<float>(depth_m);
      images.robot.link_id(u, v) = static_cast<LinkId>(1 + u * kLinks / width);
    }
  }
  return images;
}

/// Depth of a sphere around (0, 0, 1.5), near (-1) or far (+1) side; NaN beside it.
double sphere_m(double x, double y, double radius_m, int side) {
  constexpr double kCentre_m = 1.5;
  const double a = x * x + y * y + 1;
  const double root = kCentre_m * kCentre_m - a * (kCentre_m * kCentre_m - radius_m * radius_m);
  return (kCentre_m + side * std::sqrt(root)) / a;
}

sim::ImagePair in_shell(int width, int height, int side) {
  return draw(
      width, height, [side](double x, double y) { return sphere_m(x, y, 0.3, side); },
      [](double x, double y) { return sphere_m(x, y, 0.45, +1); });
}

}  // namespace

sim::ImagePair tilted_plates(double tilt_rad, int width, int height) {
  const double sine = std::sin(tilt_rad);
  const double cosine = std::cos(tilt_rad);
  const auto plane_m = [=](double x, double distance_m) {
    const double facing = cosine + sine * x;
    return facing > 0 ? distance_m / facing : std::nan("");
  };
  return draw(
      width, height,
      [=](double x, double y) {
        return std::abs(x) < 0.2 && std::abs(y) < 0.2 ? plane_m(x, 1.2) : std::nan("");
      },
      [=](double x, double) { return plane_m(x, 1.5); });
}

sim::ImagePair ball_in_shell(int width, int height) { return in_shell(width, height, -1); }

sim::ImagePair bowl_in_shell(int width, int height) { return in_shell(width, height, +1); }

}  // namespace berth::testing
