#pragma once

#include <vector>

#include "berth/self_filter/discs.hpp"
#include "berth/self_filter/outline.hpp"
#include "berth/self_filter/settings.hpp"
#include "berth/types/camera.hpp"
#include "berth/types/robot_image.hpp"

namespace berth {

/// The robot's silhouettes, grown: where a link ends against the background, or against a part of
/// the robot that lies deeper, a disc around each outline pixel takes what lies not in front of it.
/// Environment grows too, but not for flying patches (outline.hpp).
class GrownRobot {
 public:
  /// `grown` is PixelFate::padding (a disc has the link's padding for a radius, as large in the
  /// image as that is at the pixel's depth) or PixelFate::flying_patch (flying_patch_radius_m in
  /// its place). All have to outlive the growth.
  void begin(const Camera& camera, const RobotImage& robot, const SelfFilterSettings& settings,
             const Outline& outline, PixelFate grown);

  /// Makes the discs of one row of tiles, whose outline was found. Each row is made once, by any
  /// thread.
  void make_discs(int tile_row);

  /// After all rows are made.
  void end_discs();

  /// Gives obstacles in one row of tiles that belong to the grown robot the fate `grown`,
  /// and takes their depths. Each row is grown once, by any thread.
  void grow(int tile_row, DepthView sensor_depth_m, ObstacleImage& out);

  /// Which obstacles of a tile belong to the grown robot. Each row of tiles is asked by
  /// one thread at a time.
  TileBits covered(int column, int tile_row, DepthView sensor_depth_m,
                   const Image<PixelFate>& fate);

 private:
  struct Radius {
    double u_px;
    double v_px;
  };
  struct Row {
    std::vector<Disc> discs;
    /// Scratch: the tiles of discs that reach into a tile.
    std::vector<NearDiscTile> near;
  };

  Radius radius_of(LinkId id, float depth_m) const;
  DiscTile append_discs(const TileBits& outline, const PixelRect& pixels,
                        std::vector<Disc>& discs) const;
  void reach_from(const DiscTile& tile);
  void collect_near(const PixelRect& pixels, std::vector<NearDiscTile>& near) const;

  const Camera* camera_ = nullptr;
  const RobotImage* robot_ = nullptr;
  const SelfFilterSettings* settings_ = nullptr;
  const Outline* outline_ = nullptr;
  PixelFate grown_ = PixelFate::padding;
  Tolerance tolerance_{};
  TileGrid grid_;
  /// The farthest of all tiles.
  int reach_px_ = -1;
  /// Of each tile, whether discs reach into it.
  std::vector<std::uint8_t> is_reached_;
  /// Of the whole grid; only those within outline_->tiles() are up to date.
  std::vector<DiscTile> tiles_;
  std::vector<Row> rows_;
};

}  // namespace berth
