#include "planner_octomap.hpp"

#include <octomap/octomap.h>

#include <octomap_msgs/conversions.h>

#include <stdexcept>

namespace berth_ros {

octomap_msgs::msg::Octomap octomap_of(const berth::VoxelGrid& grid, bool hidden_is_occupied,
                                      const std_msgs::msg::Header& header) {
  octomap::OcTree tree(grid.edge_m);
  const float occupied = tree.getClampingThresMaxLog();
  const float free = tree.getClampingThresMinLog();
  grid.for_each([&](const Eigen::Vector3i& at, berth::Voxel voxel) {
    const bool is_occupied =
        voxel == berth::Voxel::occupied || (hidden_is_occupied && voxel == berth::Voxel::hidden);
    if (!is_occupied && voxel != berth::Voxel::free) return;
    const Eigen::Vector3d centre = grid.centre_m(at);
    tree.setNodeValue(
        octomap::point3d(static_cast<float>(centre.x()), static_cast<float>(centre.y()),
                         static_cast<float>(centre.z())),
        is_occupied ? occupied : free, true);
  });
  tree.updateInnerOccupancy();
  octomap_msgs::msg::Octomap out;
  // It prunes the tree.
  if (!octomap_msgs::binaryMapToMsg(tree, out)) {
    throw std::runtime_error("octomap could not write its tree");
  }
  out.header = header;
  return out;
}

}  // namespace berth_ros
