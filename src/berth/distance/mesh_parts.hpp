// The connected parts of a mesh, and what they enclose.
#pragma once

#include <Eigen/Geometry>
#include <array>
#include <vector>

#include "berth/robot/triangle_mesh.hpp"

namespace berth::mesh {

/// Parts of a mesh that share no corner. One encloses a space if each of its edges has an even
/// number of triangles.
class MeshParts {
 public:
  explicit MeshParts(const TriangleMesh& mesh);

  /// A corner of each part, in the mesh's frame.
  const std::vector<Eigen::Vector3f>& corners_m() const { return corners_m_; }
  /// Whether some part encloses the point, which lies on none of them.
  bool enclose(const Eigen::Vector3d& p_m) const;

 private:
  using Triangle = std::array<Eigen::Vector3f, 3>;
  struct Closed {
    Eigen::AlignedBox3f box_m;
    std::vector<Triangle> triangles_m;
  };

  std::vector<Eigen::Vector3f> corners_m_;
  std::vector<Closed> closed_;
};

}  // namespace berth::mesh
