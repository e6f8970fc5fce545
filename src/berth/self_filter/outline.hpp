// Inside self_filter/ only.
#pragma once

#include <array>
#include <cstdint>

#include "berth/self_filter/tiles.hpp"
#include "berth/self_filter/tolerance.hpp"
#include "berth/types/robot_image.hpp"

namespace berth {

/// Of each row of a tile, bit i is its column i.
using TileBits = std::array<std::uint32_t, kTileHeight_px>;

/// Which pixels of a tile belong to the robot's outline: those where a link ends against the
/// background, scenery, or a deeper part of the robot, or where its surface turns away by more than
/// 45 degrees (deeper by more than pixel_rad, a pixel's angle, of its depth): a calibration error
/// moves the sensor's image of it sideways, and there sideways means deeper. At the image's border
/// the outline goes on outside.
///
/// Scenery has an outline only where it ends against the background, or against what is deeper by
/// more than the tolerance there. A table that the camera sees at a flat angle turns away all over:
/// if all of it were outline, it would take the lower part of what stands on it.
TileBits outline_of(const RobotImage& robot, const PixelRect& tile, float pixel_rad,
                    const Tolerance& tolerance);

}  // namespace berth
