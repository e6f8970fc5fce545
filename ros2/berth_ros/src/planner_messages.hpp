// Space as planners read it.
#pragma once

#include <nav_msgs/msg/occupancy_grid.hpp>
#include <sensor_msgs/msg/point_cloud2.hpp>
#include <std_msgs/msg/header.hpp>

#include "berth/space/voxel_grid.hpp"

namespace berth_ros {

/// The centres of all voxels of one kind, x, y, z in metres, in the order of the grid.
sensor_msgs::msg::PointCloud2 points_of(const berth::VoxelGrid& grid, berth::Voxel wanted,
                                        const std_msgs::msg::Header& header);

/// The columns of the grid between two heights in metres: 100 where something is occupied, 0 where
/// all is free, else -1.
nav_msgs::msg::OccupancyGrid occupancy_of(const berth::VoxelGrid& grid, double from_m, double to_m,
                                          const std_msgs::msg::Header& header);

}  // namespace berth_ros
