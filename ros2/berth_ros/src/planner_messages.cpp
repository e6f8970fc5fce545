#include "planner_messages.hpp"

#include <algorithm>
#include <sensor_msgs/point_cloud2_iterator.hpp>

namespace berth_ros {
namespace {

constexpr std::int8_t kOccupied = 100;
constexpr std::int8_t kFree = 0;
constexpr std::int8_t kUnknown = -1;

/// Which layers reach between two heights.
std::pair<int, int> layers_between(const berth::VoxelGrid& grid, double from_m, double to_m) {
  const auto layer = [&](double height_m) {
    return static_cast<int>(std::floor(height_m / grid.edge_m)) - grid.first.z();
  };
  return {std::clamp(layer(from_m), 0, grid.count.z()),
          std::clamp(layer(to_m) + 1, 0, grid.count.z())};
}

std::int8_t column_of(const berth::VoxelGrid& grid, int x, int y, int z_begin, int z_end) {
  std::int8_t column = z_begin < z_end ? kFree : kUnknown;
  for (int z = z_begin; z < z_end; ++z) {
    const berth::Voxel voxel = grid(x, y, z);
    if (voxel == berth::Voxel::occupied) return kOccupied;
    if (voxel != berth::Voxel::free) column = kUnknown;
  }
  return column;
}

}  // namespace

sensor_msgs::msg::PointCloud2 points_of(const berth::VoxelGrid& grid, berth::Voxel wanted,
                                        const std_msgs::msg::Header& header) {
  sensor_msgs::msg::PointCloud2 cloud;
  cloud.header = header;
  cloud.is_dense = true;
  sensor_msgs::PointCloud2Modifier modifier(cloud);
  modifier.setPointCloud2FieldsByString(1, "xyz");
  modifier.resize(std::count(grid.voxels.begin(), grid.voxels.end(), wanted));
  sensor_msgs::PointCloud2Iterator<float> point(cloud, "x");
  grid.for_each([&](const Eigen::Vector3i& at, berth::Voxel voxel) {
    if (voxel != wanted) return;
    const Eigen::Vector3f centre = grid.centre_m(at).cast<float>();
    std::copy_n(centre.data(), 3, &point[0]);
    ++point;
  });
  return cloud;
}

nav_msgs::msg::OccupancyGrid occupancy_of(const berth::VoxelGrid& grid, double from_m, double to_m,
                                          const std_msgs::msg::Header& header) {
  nav_msgs::msg::OccupancyGrid out;
  out.header = header;
  out.info.map_load_time = header.stamp;
  out.info.resolution = static_cast<float>(grid.edge_m);
  out.info.width = static_cast<std::uint32_t>(grid.count.x());
  out.info.height = static_cast<std::uint32_t>(grid.count.y());
  out.info.origin.position.x = grid.corner_m().x();
  out.info.origin.position.y = grid.corner_m().y();
  out.info.origin.orientation.w = 1;
  const auto [z_begin, z_end] = layers_between(grid, from_m, to_m);
  for (int y = 0; y < grid.count.y(); ++y) {
    for (int x = 0; x < grid.count.x(); ++x) {
      out.data.push_back(column_of(grid, x, y, z_begin, z_end));
    }
  }
  return out;
}

}  // namespace berth_ros
