#pragma once

#include <cstdint>

#include "berth/types/robot_image.hpp"

namespace berth {

/// The pixels of one link in tile 0 to 15 of a square of 4 x 4 tiles.
struct LinkTile {
  std::uint64_t bits;
  int pixels;
  float depth_lo_m;
  float depth_hi_m;
  LinkId id;
  int tile;
};

}  // namespace berth
