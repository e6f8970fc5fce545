// Inside render/ only.
#pragma once

#include <Eigen/Geometry>
#include <vector>

#include "berth/render/robot_renderer.hpp"
#include "berth/render/triangle_planes.hpp"
#include "berth/robot/robot_model.hpp"

namespace berth {

/// The links' triangles in the order in which they are drawn: constant once built.
class LinkMeshes {
 public:
  struct LinkMesh {
    /// In RobotModel::links and RobotPose::X_BL.
    std::size_t link_index;
    LinkId id;
    Eigen::AlignedBox3f box_L_m;
    /// The last block is filled up with its last triangle.
    std::vector<TriangleBlock> blocks;
  };

  /// Leaves out ignored links, links without geometry, and triangles without area.
  LinkMeshes(const RobotModel& model, DrawnLinks drawn);

  const std::vector<LinkMesh>& links() const { return links_; }

 private:
  std::vector<LinkMesh> links_;
};

}  // namespace berth
