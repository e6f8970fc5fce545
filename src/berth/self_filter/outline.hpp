// Inside self_filter/ only.
#pragma once

#include <vector>

#include "berth/self_filter/settings.hpp"
#include "berth/self_filter/tiles.hpp"
#include "berth/types/camera.hpp"
#include "berth/types/robot_image.hpp"

namespace berth {

/// The pixels of the robot's outline: those where a link ends against the background, environment,
/// or a deeper part of the robot, or where its surface turns away by more than 45 degrees (deeper
/// by more than a pixel's angle of its depth): a calibration error moves the sensor's image of it
/// sideways, and there sideways means deeper. At the image's border the outline goes on outside.
///
/// Environment has an outline only where it ends against the background, or against what is deeper
/// by more than the tolerance there. A table that the camera sees at a flat angle turns away all
/// over: if all of it were outline, it would take the lower part of what stands on it.
class Outline {
 public:
  /// `robot` has to outlive the outline.
  void begin(const Camera& camera, const RobotImage& robot, const Tolerance& tolerance);

  /// Finds it in one row of tiles. Each row is found once, by any thread.
  void find(int tile_row);

  /// No other tiles have any.
  const PixelRect& tiles() const { return robot_tiles_; }

  /// In one of tiles(), whose row was found.
  const TileBits& in_tile(int column, int row) const { return bits_[grid_.index(column, row)]; }

 private:
  const RobotImage* robot_ = nullptr;
  Tolerance tolerance_{};
  float pixel_rad_ = 0;
  TileGrid grid_;
  PixelRect robot_tiles_;
  /// Of the whole grid; only those within robot_tiles_ are up to date.
  std::vector<TileBits> bits_;
};

}  // namespace berth
