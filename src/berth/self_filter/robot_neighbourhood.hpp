#pragma once

#include <vector>

#include "berth/self_filter/near_surface.hpp"
#include "berth/types/camera.hpp"
#include "berth/types/obstacle_image.hpp"
#include "berth/types/robot_image.hpp"

namespace berth {

/// What is near the robot's visible surface in space (evaluated links, not scenery). Tile by tile:
/// the boxes around two tiles of pixels settle most questions for all of them. A robot pixel is
/// the point at its centre, back-projected at its depth, and so is an obstacle's.
class RobotNeighbourhood {
 public:
  /// `camera` and `robot` have to outlive the questions.
  void begin(const Camera& camera, const RobotImage& robot, double radius_m);

  /// Sorts the robot's pixels in one row of tiles. Each row is added once, by any thread.
  void add_robot(int tile_row);

  /// After all rows are added.
  void end_robot();

  /// For each obstacle pixel in one row of tiles that some robot pixel is within `radius_m` of
  /// (Euclidean), writes 1 to near(u, v); leaves 0 elsewhere. Each row is searched once, by any
  /// thread.
  void find_near(int tile_row, DepthView sensor_depth_m, const Image<PixelFate>& fate,
                 Image<std::uint8_t>& near);

  /// The tiles in one row that hold such a pixel.
  const std::vector<PixelRect>& near_tiles(int tile_row) const { return rows_[tile_row].near; }
  int tile_rows() const { return grid_.rows(); }

 private:
  struct Row {
    std::vector<PixelRect> near;
    /// Scratch of find_near.
    std::vector<RobotTile> robot;
  };
  /// The boxes of sixteen groups, and which groups they are.
  struct GroupPack {
    BoxPack boxes;
    std::size_t group[kPackSize];
  };

  RobotSurface surface() const { return {*robot_, ray_x_.data(), ray_y_.data()}; }
  PixelRect pixels_of(std::size_t group, int i) const;
  void set_range();
  PixelRect candidate_tiles() const;
  bool find_near_in_tile(const PixelRect& pixels, const CandidatePixels& candidates,
                         std::vector<RobotTile>& robot_tiles, Image<std::uint8_t>& near) const;

  const Camera* camera_ = nullptr;
  const RobotImage* robot_ = nullptr;
  float radius_m_ = 0;
  TileGrid grid_;
  int group_columns_ = 0;
  std::vector<float> ray_x_;
  std::vector<float> ray_y_;
  /// The boxes of the robot's pixels in 4 x 4 tiles each.
  std::vector<BoxPack> groups_;
  /// The groups that show the robot, and the box of them all.
  std::vector<GroupPack> packs_;
  BoxC bounds_;
  /// No pixel elsewhere is near.
  DepthRange range_{};
  PixelRect candidate_tiles_;
  std::vector<Row> rows_;
};

}  // namespace berth
