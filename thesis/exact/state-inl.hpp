// What the search of one link knows while it runs.
#if defined(BERTH_DISTANCE_EXACT_STATE_INL_HPP) == defined(HWY_TARGET_TOGGLE)
#ifdef BERTH_DISTANCE_EXACT_STATE_INL_HPP
#undef BERTH_DISTANCE_EXACT_STATE_INL_HPP
#else
#define BERTH_DISTANCE_EXACT_STATE_INL_HPP
#endif

#include <cmath>

#include "thesis/exact/aligned_box-inl.hpp"
#include "thesis/exact/search.hpp"

HWY_BEFORE_NAMESPACE();
namespace berth {
namespace HWY_NAMESPACE {

/// A robot tile seen along its own surface: the boxes around it and its quarters.
struct AlignedTile {
  Axes axes;
  AlignedBox box;
  AlignedBox quarters[4];
};

/// The boxes around a node's tiles along its closest pair; made when they are first needed.
struct AlignedBoxes {
  bool is_made = false;
  Axes axes;
  alignas(64) float lo_m[3][RobotTiles::kNodeTiles];
  alignas(64) float hi_m[3][RobotTiles::kNodeTiles];
};

/// A robot node seen along the link's closest pair so far, and its tiles along their own surfaces:
/// for searches that turn out to be long.
struct AlignedNode {
  AlignedBoxes boxes;
  AlignedTile tiles[RobotTiles::kNodeTiles];
  /// Bit i is set where tiles[i] has been made.
  std::uint32_t tiles_made = 0;
};

struct Search {
  const SearchInput& input;
  const SearchLimits& limits;
  ClosestPair& best;
  BasicMetric<Lanes> metric;
  AlignedNode& aligned;

  /// Pairs at or above this distance are not looked for, and neither are those with such a depth
  /// gap.
  float limit_m2 = 0;
  float max_gap_m = 0;
  std::int64_t leaves = 0;
  std::int64_t pairs = 0;
  bool stopped = false;
  /// From this much work on, the node is worth to be aligned.
  std::int64_t align_at = 0;
  bool is_aligned = false;
};

/// What the search has done so far, in pairs: to prune a pair of tiles takes as long as some.
inline std::int64_t work_of(const Search& search) { return search.pairs + 128 * search.leaves; }

/// Above the square root of m2 by more than all roundings.
inline float root_above(float m2) {
  return std::sqrt(m2) * (1 + 8 * std::numeric_limits<float>::epsilon());
}

/// Below the square root of m2 by more than all roundings.
inline float root_below(float m2) {
  return std::sqrt(m2) * (1 - 8 * std::numeric_limits<float>::epsilon());
}

/// Takes over that `best` has changed. Without a pair, a tolerance could miss those in range.
inline void update_limit(Search& search) {
  search.limit_m2 = search.best.squared_m2;
  if (search.best.ru >= 0 && search.limits.tolerance_m > 0) {
    const float limit_m = std::sqrt(search.best.squared_m2) - search.limits.tolerance_m;
    search.limit_m2 = limit_m > 0 ? limit_m * limit_m : 0;
  }
  search.max_gap_m = root_above(search.limit_m2);
}

/// Whether to stop; asked before each tile, which takes about as long as a look at the clock.
inline bool is_out_of_time(Search& search) {
  if (search.stopped) return true;
  if (search.best.ru < 0 && search.leaves == 0) return false;
  search.stopped = search.limits.deadline != std::chrono::steady_clock::time_point::max() &&
                   std::chrono::steady_clock::now() >= search.limits.deadline;
  return search.stopped;
}

}  // namespace HWY_NAMESPACE
}  // namespace berth
HWY_AFTER_NAMESPACE();

#endif
