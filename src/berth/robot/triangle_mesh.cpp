#include "berth/robot/triangle_mesh.hpp"

#include <Eigen/LU>

namespace berth {

Eigen::AlignedBox3f TriangleMesh::bounding_box_m() const {
  Eigen::AlignedBox3f box;
  for (const auto& vertex : vertices_m) box.extend(vertex);
  return box;
}

void TriangleMesh::append(const TriangleMesh& other, const Eigen::Affine3d& X) {
  const auto first = static_cast<std::uint32_t>(vertices_m.size());
  for (const auto& vertex : other.vertices_m) {
    vertices_m.push_back((X * vertex.cast<double>()).cast<float>());
  }
  const bool mirrors = X.linear().determinant() < 0;
  for (const auto& [a, b, c] : other.triangles) {
    triangles.push_back({first + a, first + (mirrors ? c : b), first + (mirrors ? b : c)});
  }
}

}  // namespace berth
