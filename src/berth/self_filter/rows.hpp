// Inside self_filter/ only: the rules that look at single pixels, row by row in vectors. Every
// instruction set computes the same bits.
#pragma once

#include <array>
#include <cstdint>

#include "berth/self_filter/settings.hpp"
#include "berth/types/obstacle_image.hpp"
#include "berth/types/robot_image.hpp"

namespace berth {

/// A reading belongs to a surface of depth z if it is not nearer than z by more than
/// constant_m + per_m z + per_m2 z^2.
struct Tolerance {
  float constant_m;
  float per_m;
  float per_m2;
};

inline Tolerance tolerance_of(const SelfFilterSettings& settings) {
  return {static_cast<float>(settings.tolerance_m), static_cast<float>(settings.tolerance_per_m),
          static_cast<float>(settings.tolerance_per_m2)};
}

/// The pixels of one row of all images that the self filter sees.
struct FilterRow {
  const float* reading_m;
  const float* robot_depth_m;
  const LinkId* link_id;
  const float* padded_depth_m;
  const float* dilated_depth_m;
  int width;
};

/// The fate of each pixel by the robot's surface, its padding and dilation, and the environment.
void classify_row(const FilterRow& row, const Tolerance& tolerance, PixelFate* fate);

/// The rule of mark_mixed_pixels for one row. `step` counts elements to the neighbour: 1 across,
/// the stride along. The pixels u_begin <= u < u_end have two neighbours on both sides.
void mark_mixed_row(const float* reading_m, std::ptrdiff_t step, int u_begin, int u_end,
                    float jump_at_1m_m, PixelFate* fate);

/// Writes the readings whose fate is obstacle, NaN elsewhere, and adds to the count of each fate.
void keep_obstacle_row(const float* reading_m, const PixelFate* fate, int width,
                       float* obstacle_depth_m, std::array<std::int64_t, kPixelFateCount>& count);

}  // namespace berth
