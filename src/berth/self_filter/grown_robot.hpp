#pragma once

#include <vector>

#include "berth/self_filter/discs.hpp"
#include "berth/self_filter/settings.hpp"
#include "berth/self_filter/tolerance.hpp"
#include "berth/types/camera.hpp"
#include "berth/types/robot_image.hpp"

namespace berth {

/// The robot's silhouettes, grown: where a link ends against the background, or against a part of
/// the robot that lies deeper, a disc around each outline pixel takes what lies not in front of it.
/// Scenery grows too, but not for islands (outline.hpp).
class GrownRobot {
 public:
  /// `grown` is PixelFate::padding (a disc has the link's padding for a radius, as large in the
  /// image as that is at the pixel's depth) or PixelFate::dilation (dilation_px pixels). `camera`,
  /// `robot` and `settings` have to outlive the growth.
  void begin(const Camera& camera, const RobotImage& robot, const SelfFilterSettings& settings,
             PixelFate grown);

  /// Finds the outline in one row of tiles. Each row is found once, by any thread.
  void find_outline(int tile_row);

  /// After all rows are found.
  void end_outline();

  /// No pixel outside of these grows.
  PixelRect grown_pixels() const {
    return clip({grown_tiles_.u_begin * kTileWidth_px, grown_tiles_.v_begin * kTileHeight_px,
                 grown_tiles_.u_end * kTileWidth_px, grown_tiles_.v_end * kTileHeight_px},
                grid_.width_px, grid_.height_px);
  }

  /// Gives obstacles and edges in one row of tiles that belong to the grown robot the fate `grown`.
  /// Each row is grown once, by any thread.
  void grow(int tile_row, const GrownImages& images);

 private:
  struct Radius {
    double u_px;
    double v_px;
  };
  struct Row {
    std::vector<Disc> discs;
    float reach_px = 0;
    /// Scratch of grow: the tiles of discs that reach into a tile.
    std::vector<NearDiscTile> near;
  };

  Radius radius_of(LinkId id, float depth_m) const;
  void append_disc(int u, int v, Row& row, DiscTile& tile) const;
  void collect_near(const PixelRect& pixels, std::vector<NearDiscTile>& near) const;

  const Camera* camera_ = nullptr;
  const RobotImage* robot_ = nullptr;
  const SelfFilterSettings* settings_ = nullptr;
  PixelFate grown_ = PixelFate::padding;
  Tolerance tolerance_{};
  TileGrid grid_;
  /// The tiles where the robot may be, and those that it may grow into.
  PixelRect robot_tiles_;
  PixelRect grown_tiles_;
  int reach_px_ = 0;
  /// Of the whole grid; only those within robot_tiles_ are up to date.
  std::vector<DiscTile> tiles_;
  std::vector<Row> rows_;
};

}  // namespace berth
