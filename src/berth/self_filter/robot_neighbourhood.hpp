#pragma once

#include <Eigen/Geometry>
#include <vector>

#include "berth/types/camera.hpp"
#include "berth/types/obstacle_image.hpp"
#include "berth/types/robot_image.hpp"

namespace berth {

/// What is near the robot's visible surface in space (evaluated links, not scenery). Tile by tile:
/// the boxes around two tiles of pixels settle most questions for all of them.
class RobotNeighbourhood {
 public:
  /// Sorts the robot's pixels into tiles. `robot` has to outlive the questions. Reuses memory.
  void build(const Camera& camera, const RobotImage& robot);

  /// For each pixel whose fate is obstacle, writes to near(u, v) whether some robot pixel's centre,
  /// back-projected at its depth, lies within `radius_m` (Euclidean) of that pixel's at depth_m(u,
  /// v); 0 for all other pixels. All images have the camera's size.
  void find_near(DepthView depth_m, const Image<PixelFate>& fate, double radius_m,
                 Image<std::uint8_t>& near);

 private:
  /// A robot pixel's place in the optical frame.
  struct Point {
    float x_m;
    float y_m;
    float z_m;
  };
  struct Tile {
    Eigen::AlignedBox3f box_C_m;
    std::uint32_t first_point;
    std::uint32_t point_count;
  };

  /// The tiles of a square of 4 x 4, which lie together.
  struct Group {
    Eigen::AlignedBox3f box_C_m;
    std::uint32_t first_tile;
    std::uint32_t tile_count;
  };

  Point back_project(int u, int v, float depth_m) const {
    return {ray_x_[u] * depth_m, ray_y_[v] * depth_m, depth_m};
  }
  void append_group(const RobotImage& robot, int first_column, int first_row);
  void append_tile(const RobotImage& robot, const PixelRect& pixels);
  void collect_tiles_near(const Eigen::AlignedBox3f& box_C_m, float radius_m);
  bool is_near(const Point& p, float radius2_m2);

  int columns_ = 0;
  int rows_ = 0;
  std::vector<float> ray_x_;
  std::vector<float> ray_y_;
  std::vector<Point> points_;
  std::vector<Tile> tiles_;
  std::vector<Group> groups_;
  Eigen::AlignedBox3f bounds_C_m_;
  /// Scratch of find_near: the tiles that a tile of candidates may be near to, and the last point
  /// that was.
  std::vector<const Tile*> near_tiles_;
  Point witness_{};
};

}  // namespace berth
