// The readings of several cameras as points.
#pragma once

#include <Eigen/Geometry>
#include <cmath>

#include "lab/bench/whole_robot_scene.hpp"

namespace berth::lab {

/// Calls take(p_B_m) for the centre of each obstacle pixel of a view, in the robot's root frame.
template <class Take>
void for_each_reading(const Camera& camera, const CameraImages& view, Take take) {
  const Eigen::Isometry3f X_BC(view.X_BC.cast<float>());
  const float inv_fx = static_cast<float>(1 / camera.fx_px);
  const float inv_fy = static_cast<float>(1 / camera.fy_px);
  for (int v = 0; v < camera.height_px; ++v) {
    const float* depth_m = view.obstacles.depth_m.row(v);
    const float y = (static_cast<float>(v) - static_cast<float>(camera.cy_px)) * inv_fy;
    for (int u = 0; u < camera.width_px; ++u) {
      if (std::isnan(depth_m[u])) continue;
      const float x = (static_cast<float>(u) - static_cast<float>(camera.cx_px)) * inv_fx;
      take(X_BC * Eigen::Vector3f(x * depth_m[u], y * depth_m[u], depth_m[u]));
    }
  }
}

}  // namespace berth::lab
