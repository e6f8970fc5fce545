// Space as an octomap, where octomap_msgs is installed.
#pragma once

#include <octomap_msgs/msg/octomap.hpp>
#include <std_msgs/msg/header.hpp>

#include "berth/space/voxel_grid.hpp"

namespace berth_ros {

/// Occupied and free voxels as a binary octree whose leaves have the grid's edge; what is neither
/// is not in it. With `hidden_is_occupied`, what is hidden is occupied.
octomap_msgs::msg::Octomap octomap_of(const berth::VoxelGrid& grid, bool hidden_is_occupied,
                                      const std_msgs::msg::Header& header);

}  // namespace berth_ros
