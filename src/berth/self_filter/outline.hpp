// Inside self_filter/ only.
#pragma once

#include <array>
#include <cstdint>

#include "berth/self_filter/tiles.hpp"
#include "berth/types/robot_image.hpp"

namespace berth {

/// Of each row of a tile, bit i is its column i.
using TileBits = std::array<std::uint32_t, kTileHeight_px>;

/// Which pixels of a tile belong to the robot's outline: those where a link ends against the
/// background, scenery, or a deeper part of the robot, or where its surface turns away by more than
/// 45 degrees (deeper by more than pixel_rad, a pixel's angle, of its depth): a calibration error
/// moves the sensor's image of it sideways, and there sideways means deeper. At the image's border
/// the outline goes on outside. Only evaluated links have one.
TileBits outline_of(const RobotImage& robot, const PixelRect& tile, float pixel_rad);

}  // namespace berth
