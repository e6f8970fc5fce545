// Inside self_filter/ only: the rules that look at single pixels, row by row in vectors. Every
// instruction set computes the same bits.
#pragma once

#include <array>
#include <cstdint>

#include "berth/self_filter/settings.hpp"
#include "berth/types/obstacle_image.hpp"
#include "berth/types/robot_image.hpp"

namespace berth {

/// The pixels of one row of all images that the self filter sees, and of those that it writes.
struct FilterRow {
  const float* reading_m;
  const float* robot_depth_m;
  const LinkId* link_id;
  PixelFate* fate;
  float* obstacle_depth_m;
};

/// Writes fate and obstacle depth of the pixels u_begin <= u < u_end by the reading alone: no
/// reading, or obstacle.
void copy_row(const FilterRow& row, int u_begin, int u_end);

/// Writes fate and obstacle depth of the pixels u_begin <= u < u_end by the reading, the robot's
/// surface and the environment's.
void classify_row(const FilterRow& row, int u_begin, int u_end, const Tolerance& tolerance);

/// Adds to the count of each fate.
void count_fates(const PixelFate* fate, int width,
                 std::array<std::int64_t, kPixelFateCount>& count);

}  // namespace berth
