// What hangs on the robot and bends: a hose, a cable.
#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <vector>

#include "berth/robot/triangle_mesh.hpp"

namespace berth {

/// The space of a link's frame L in which it may hang: all that a closed mesh encloses.
class SoftBody {
 public:
  /// Throws std::invalid_argument where the mesh is not closed.
  SoftBody(std::size_t link, const TriangleMesh& mesh_L);

  /// In RobotModel::links.
  std::size_t link() const { return link_; }
  const Eigen::AlignedBox3f& box_L_m() const { return box_L_m_; }
  /// To half a column's width across z.
  bool contains(const Eigen::Vector3f& p_L_m) const;

 private:
  std::size_t column_of(int x, int y) const;

  std::size_t link_ = 0;
  Eigen::AlignedBox3f box_L_m_;
  float column_m_ = 0;
  int columns_x_ = 0;
  int columns_y_ = 0;
  /// Where the surface crosses each column's middle, along z and in order; those of column i begin
  /// at first_[i].
  std::vector<std::uint32_t> first_;
  std::vector<float> crossings_z_m_;
};

}  // namespace berth
