#pragma once

#include <cstddef>

namespace berth::lab {

/// The nearest neighbour of any of a link's points: what nanoflann calls a result set. A
/// search begins with the best of the searches before it, so that most end at the tree's root.
struct ClosestSoFar {
  using DistanceType = float;

  float squared_m2;
  bool found = false;

  bool full() const { return true; }
  float worstDist() const { return squared_m2; }
  bool addPoint(float candidate_m2, std::size_t /*index*/) {
    if (candidate_m2 < squared_m2) {
      squared_m2 = candidate_m2;
      found = true;
    }
    return true;
  }
};

}  // namespace berth::lab
