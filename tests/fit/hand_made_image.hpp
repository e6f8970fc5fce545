// Robots whose images can be told without a renderer.
#pragma once

#include <algorithm>
#include <cmath>

#include "berth/types/camera.hpp"
#include "berth/types/robot_image.hpp"

namespace berth {

inline constexpr Camera kHandMadeCamera{120, 90, 100, 100, 59.5, 44.5};
inline constexpr float kWall_m = 3;

struct HandMadeImage {
  Camera camera = kHandMadeCamera;
  RobotImage robot{DepthImage(camera.width_px, camera.height_px, kNoDepth),
                   Image<LinkId>(camera.width_px, camera.height_px, kNoLink)};
};

/// A link as a plate that faces the camera.
inline void add_plate(const PixelRect& pixels, float depth_m, LinkId id, HandMadeImage& image) {
  for (int v = pixels.v_begin; v < pixels.v_end; ++v) {
    for (int u = pixels.u_begin; u < pixels.u_end; ++u) {
      image.robot.depth_m(u, v) = depth_m;
      image.robot.link_id(u, v) = id;
    }
  }
}

/// Link 1 as a plate at 1 m.
inline HandMadeImage plate(const PixelRect& pixels) {
  HandMadeImage image;
  add_plate(pixels, 1, 1, image);
  return image;
}

/// Link 1 as a ball.
inline HandMadeImage ball(const Eigen::Vector3d& centre_C_m, double radius_m) {
  HandMadeImage image;
  const Camera& camera = image.camera;
  for (int v = 0; v < camera.height_px; ++v) {
    for (int u = 0; u < camera.width_px; ++u) {
      const Eigen::Vector3d ray((u - camera.cx_px) / camera.fx_px,
                                (v - camera.cy_px) / camera.fy_px, 1);
      const double half = ray.dot(centre_C_m) / ray.squaredNorm();
      const double under_root =
          half * half - (centre_C_m.squaredNorm() - radius_m * radius_m) / ray.squaredNorm();
      if (under_root < 0) continue;
      image.robot.depth_m(u, v) = static_cast<float>(half - std::sqrt(under_root));
      image.robot.link_id(u, v) = 1;
    }
  }
  return image;
}

/// What an ideal camera sees of it before a wall.
inline DepthImage sensed(const RobotImage& robot, float wall_m = kWall_m) {
  DepthImage depth_m = robot.depth_m;
  std::replace_if(
      depth_m.pixels().begin(), depth_m.pixels().end(), [](float z_m) { return std::isnan(z_m); },
      wall_m);
  return depth_m;
}

}  // namespace berth
