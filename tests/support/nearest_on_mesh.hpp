// The point of a mesh that is nearest to a given one, by Embree's tree.
#pragma once

#include <Eigen/Core>
#include <limits>
#include <memory>

#include "berth/robot/triangle_mesh.hpp"

namespace berth::testing {

struct NearestPoint {
  /// Infinite where the mesh has nothing nearer than was asked for.
  double distance_m = std::numeric_limits<double>::infinity();
  Eigen::Vector3d point_m = Eigen::Vector3d::Constant(std::numeric_limits<double>::quiet_NaN());
};

/// One mesh; constant, may be asked by several threads.
class NearestOnMesh {
 public:
  /// Throws std::runtime_error where Embree fails.
  explicit NearestOnMesh(const TriangleMesh& mesh);
  ~NearestOnMesh();
  NearestOnMesh(NearestOnMesh&&) noexcept;
  NearestOnMesh& operator=(NearestOnMesh&&) noexcept;

  /// In the mesh's frame. Triangles are computed in doubles.
  NearestPoint operator()(const Eigen::Vector3d& p,
                          double less_than_m = std::numeric_limits<double>::infinity()) const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace berth::testing
