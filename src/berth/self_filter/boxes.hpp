// Inside self_filter/ only: distances between boxes in space, in vectors. Bounds and single
// distances do the same operations in the same order, so that rounding cannot part them.
#pragma once

#include <algorithm>
#include <cstdint>
#include <limits>

namespace berth {

/// A box in the optical frame C; inside out where there is nothing.
struct BoxC {
  float min_m[3] = {kInfinity, kInfinity, kInfinity};
  float max_m[3] = {-kInfinity, -kInfinity, -kInfinity};

  bool empty() const { return min_m[2] > max_m[2]; }

 private:
  static constexpr float kInfinity = std::numeric_limits<float>::infinity();
};

/// The least box that holds both.
inline BoxC united(const BoxC& a, const BoxC& b) {
  BoxC box;
  for (int axis = 0; axis < 3; ++axis) {
    box.min_m[axis] = std::min(a.min_m[axis], b.min_m[axis]);
    box.max_m[axis] = std::max(a.max_m[axis], b.max_m[axis]);
  }
  return box;
}

/// Sixteen boxes side by side; empty at first.
inline constexpr int kPackSize = 16;
struct BoxPack {
  float min_m[3][kPackSize];
  float max_m[3][kPackSize];

  BoxPack();
  void set(int i, const BoxC& box);
  BoxC get(int i) const;
};

/// The box around all boxes of a pack.
BoxC box_of_boxes(const BoxPack& pack);

/// Bit i: of the pack's box i, some point may be (`some`), or every point is (`all`) within the
/// radius of every point of the box asked for.
struct NearBits {
  std::uint32_t some = 0;
  std::uint32_t all = 0;
};
NearBits near_boxes(const BoxC& box, const BoxPack& pack, float radius2_m2);

}  // namespace berth
