#pragma once

#include <Eigen/Geometry>
#include <array>
#include <cstdint>
#include <vector>

namespace berth {

/// Triangles by the indices of their corners; metres. Their winding carries no meaning but for
/// vertex_normals.
struct TriangleMesh {
  std::vector<Eigen::Vector3f> vertices_m;
  std::vector<std::array<std::uint32_t, 3>> triangles;

  bool empty() const { return triangles.empty(); }

  // In a source, since most of berth includes this, and Eigen's part of them takes half a second to
  // compile.
  Eigen::AlignedBox3f bounding_box_m() const;

  /// Appends `other`, each of its vertices moved by `X`, which may scale.
  void append(const TriangleMesh& other, const Eigen::Affine3d& X);
};

}  // namespace berth
