// Inside berth only: a link's surface in balls, and points on it.
#pragma once

#include <Eigen/Core>
#include <array>

#include "berth/robot/triangle_mesh.hpp"

namespace berth::mesh {

/// Eight balls, or points of radius 0, in one frame; those of negative radius are none.
struct EightBalls {
  alignas(32) std::array<float, 8> x_m{};
  alignas(32) std::array<float, 8> y_m{};
  alignas(32) std::array<float, 8> z_m{};
  alignas(32) std::array<float, 8> radius_m{-1, -1, -1, -1, -1, -1, -1, -1};

  void set(std::size_t i, const Eigen::Vector3f& p_m, float r_m) {
    x_m[i] = p_m.x(), y_m[i] = p_m.y(), z_m[i] = p_m.z(), radius_m[i] = r_m;
  }
};

/// Every point of a surface lies in one of `coarse`, and in one of the fine balls of that one. Most
/// centres lie inside of it, so that the balls stick out by less than their radii.
struct LinkBalls {
  EightBalls coarse;
  std::array<EightBalls, 8> fine;
  /// Points of the surface in each coarse ball, and in each fine one.
  std::array<EightBalls, 8> coarse_points;
  std::array<std::array<EightBalls, 8>, 8> fine_points;
  /// All of the surface is in this ball.
  Eigen::Vector3f centre_m = Eigen::Vector3f::Zero();
  float radius_m = 0;
};

/// In the mesh's frame; no ball at all for an empty mesh. The same for the same mesh.
LinkBalls build_link_balls(const TriangleMesh& mesh);

}  // namespace berth::mesh
