#include "thesis/exact/search.hpp"

#include <cmath>

// Compiles the rest of this file once for each instruction set.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "thesis/exact/search.cpp"
#include "hwy/foreach_target.h"

#include "thesis/exact/leaf-inl.hpp"
#include "thesis/exact/sharpen-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace berth {
namespace HWY_NAMESPACE {

/// A robot node against one obstacle tile.
inline void search_tile(Search& search, const RobotTiles::Node& robot, const PixelBox& box) {
  if (is_out_of_time(search)) return;
  Bounds bounds = bound_robot_tiles(search, robot, box);
  if (bounds.may_improve == 0) return;
  DepthSquareCopy<kTilePx> obstacle_copy;
  const LeafTile obstacle = obstacle_tile(search, box, obstacle_copy);
  search.is_aligned |= search.best.ru >= 0 && work_of(search) >= search.align_at;
  if (search.is_aligned) sharpen(search, robot, obstacle, bounds);
  DepthSquareCopy<kTilePx> robot_copy;
  const Candidates near = nearest_first(bounds);
  for (int k = 0; k < near.count; ++k) {
    const int i = near.index[k];
    if (!(bounds.squared_m2[i] < search.limit_m2)) return;
    if (is_out_of_time(search)) return;
    ++search.leaves;
    const LeafTile tile = robot_tile(search, robot, i, robot_copy);
    if (search.is_aligned) {
      search_leaf_aligned(search, aligned_tile(search, i, tile), tile, obstacle);
    } else {
      search_leaf(search, tile, obstacle);
    }
  }
}

/// A robot node against all below a square, nearest first.
void search_square(Search& search, const RobotTiles::Node& robot, Square square) {
  const Bounds bounds = bound_children(search, robot.box, square);
  const Candidates near = nearest_first(bounds);
  for (int k = 0; k < near.count; ++k) {
    const int i = near.index[k];
    if (!(bounds.squared_m2[i] < search.limit_m2)) return;
    if (search.stopped) return;
    if (square.level == 0) {
      search_tile(search, robot, child_box(search.input.obstacles, square, i));
    } else {
      search_square(search, robot, child_of(square, i));
    }
  }
}

/// The least bound; some bound must be able to improve.
inline int nearest_of(const Bounds& bounds) {
  int nearest = lowest_bit(bounds.may_improve);
  for (std::uint64_t bits = bounds.may_improve; bits != 0; bits &= bits - 1) {
    const int i = lowest_bit(bits);
    if (bounds.squared_m2[i] < bounds.squared_m2[nearest]) nearest = i;
  }
  return nearest;
}

/// The last bound of a greedy descent, a guess of how near the node's closest pair is. +inf only
/// where nothing below the root can improve on the best pair; a descent that ends early proves
/// nothing.
float promise_of(const Search& search, const RobotTiles::Node& robot) {
  Square square = root_of(search.input.obstacles);
  float promise_m2 = HUGE_VALF;
  while (true) {
    const Bounds bounds = bound_children(search, robot.box, square);
    if (bounds.may_improve == 0) return promise_m2;
    const int nearest = nearest_of(bounds);
    promise_m2 = bounds.squared_m2[nearest];
    if (square.level == 0) return promise_m2;
    square = child_of(square, nearest);
  }
}

/// The nodes that may improve on the best pair, most promising first. Returns how many.
int order_nodes(const Search& search, int last_node) {
  ExactWorkspace::NodeOrder* order = search.input.order;
  int count = 0;
  for (int n = last_node; n >= 0; n = search.input.robot.nodes[n].next) {
    const float promise_m2 = promise_of(search, search.input.robot.nodes[n]);
    if (promise_m2 < HUGE_VALF) order[count++] = {promise_m2, n};
  }
  sort_by_bound(order, count);
  return count;
}

/// The least bound of a robot node and any tile below a square, where it is less than `least_m2`.
float least_tile_bound_m2(const Search& search, const RobotTiles::Node& robot, Square square,
                          float least_m2) {
  const Bounds bounds = bound_children(search, robot.box, square);
  const Candidates near = nearest_first(bounds);
  for (int k = 0; k < near.count; ++k) {
    const float bound_m2 = bounds.squared_m2[near.index[k]];
    if (!(bound_m2 < least_m2)) break;
    least_m2 = square.level == 0
                   ? bound_m2
                   : least_tile_bound_m2(search, robot, child_of(square, near.index[k]), least_m2);
  }
  return least_m2;
}

SearchResult search_nodes(const SearchInput& input, int last_node, const SearchLimits& limits,
                          ClosestPair& best) {
  AlignedNode aligned;
  Search search{input, limits, best, broadcast(input.metric), aligned};
  update_limit(search);
  const int count = order_nodes(search, last_node);
  int k = 0;
  for (; k < count && !search.stopped; ++k) {
    search.is_aligned = aligned.boxes.is_made = false;
    aligned.tiles_made = 0;
    search.align_at = work_of(search) + limits.most_work_unaligned;
    search_square(search, input.robot.nodes[input.order[k].node], root_of(input.obstacles));
  }
  float bound_m2 = search.limit_m2;
  if (search.stopped) {
    // The last node was left half searched.
    for (--k; k < count; ++k) {
      bound_m2 = least_tile_bound_m2(search, input.robot.nodes[input.order[k].node],
                                     root_of(input.obstacles), bound_m2);
    }
  }
  return {root_below(bound_m2), !search.stopped, search.pairs};
}

}  // namespace HWY_NAMESPACE
}  // namespace berth
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace berth {

HWY_EXPORT(search_nodes);

SearchResult search_link(const SearchInput& input, int last_node, const SearchLimits& limits,
                         ClosestPair& best) {
  return HWY_DYNAMIC_DISPATCH(search_nodes)(input, last_node, limits, best);
}

}  // namespace berth
#endif  // HWY_ONCE
