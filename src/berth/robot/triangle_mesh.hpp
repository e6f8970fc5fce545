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

  Eigen::AlignedBox3f bounding_box_m() const {
    Eigen::AlignedBox3f box;
    for (const auto& vertex : vertices_m) box.extend(vertex);
    return box;
  }

  /// Appends `other`, each of its vertices moved by `X`, which may scale.
  void append(const TriangleMesh& other, const Eigen::Affine3d& X) {
    const auto first = static_cast<std::uint32_t>(vertices_m.size());
    for (const auto& vertex : other.vertices_m) {
      vertices_m.push_back((X * vertex.cast<double>()).cast<float>());
    }
    const bool mirrors = X.linear().determinant() < 0;
    for (const auto& [a, b, c] : other.triangles) {
      triangles.push_back({first + a, first + (mirrors ? c : b), first + (mirrors ? b : c)});
    }
  }
};

}  // namespace berth
