// The point of a mesh that is nearest to a given one, by Embree's tree.
#pragma once

#include <Eigen/Core>
#include <array>
#include <limits>
#include <vector>

#include "sim/embree_scene.hpp"

namespace berth::sim {

struct NearestPoint {
  /// Infinite where the mesh has nothing nearer than was asked for.
  double distance_m = std::numeric_limits<double>::infinity();
  Eigen::Vector3d point_m = Eigen::Vector3d::Constant(std::numeric_limits<double>::quiet_NaN());
};

/// One mesh; constant, may be asked by several threads.
class NearestOnMesh {
 public:
  using Corners = std::array<Eigen::Vector3d, 3>;

  /// Throws std::runtime_error where Embree fails.
  explicit NearestOnMesh(const TriangleMesh& mesh);

  /// In the mesh's frame. Triangles are computed in doubles.
  NearestPoint operator()(const Eigen::Vector3d& p,
                          double less_than_m = std::numeric_limits<double>::infinity()) const;

 private:
  std::vector<Corners> triangles_;
  EmbreeDevice device_;
  EmbreeScene scene_;
};

}  // namespace berth::sim
