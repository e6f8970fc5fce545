#include "berth/distance/exact_search.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

// Compiles the rest of this file once for each instruction set.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "berth/distance/exact_search.cpp"
#include "hwy/foreach_target.h"

#include "berth/distance/exact_leaf-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace berth {
namespace HWY_NAMESPACE {

constexpr int kChildren = ObstacleTree::kChildren;

/// A node of the obstacle tree.
struct Square {
  int level;
  int column;
  int row;
};

inline Square root_of(const ObstacleTree& tree) { return {tree.level_count - 1, 0, 0}; }

inline Square child_of(Square square, int i) {
  return {square.level - 1, 4 * square.column + i % 4, 4 * square.row + i / 4};
}

inline std::size_t index_of(const ObstacleTree& tree, Square square) {
  return static_cast<std::size_t>(square.row) * tree.levels[square.level].columns + square.column;
}

inline const ObstacleTree::Node& node_of(const ObstacleTree& tree, Square square) {
  return tree.levels[square.level].nodes[index_of(tree, square)];
}

inline PixelBox child_box(const ObstacleTree& tree, Square square, int i) {
  const ObstacleTree::Node& node = node_of(tree, square);
  const auto side = static_cast<float>(tree.levels[square.level].child_px);
  const float u = side * static_cast<float>(4 * square.column + i % 4);
  const float v = side * static_cast<float>(4 * square.row + i / 4);
  return {u, u + side, v, v + side, node.depth_lo_m[i], node.depth_hi_m[i]};
}

/// Bounds of 16 boxes, and which of them may improve on the best pair.
struct Bounds {
  alignas(64) float squared_m2[kChildren];
  std::uint64_t may_improve = 0;
};

HWY_INLINE void put(const Search& search, Lanes bound_m2, int i, Bounds& out) {
  store(bound_m2, out.squared_m2 + i);
  out.may_improve |= bits_less(bound_m2, Lanes(search.best.squared_m2)) << i;
}

/// The bound of a robot box and each child of an obstacle square.
inline Bounds bound_children(const Search& search, const PixelBox& robot, Square square) {
  const ObstacleTree::Node& node = node_of(search.obstacles, square);
  const auto side = static_cast<float>(search.obstacles.levels[square.level].child_px);
  const Lanes u_begin(side * static_cast<float>(4 * square.column));
  const Lanes v_begin(side * static_cast<float>(4 * square.row));
  const Lanes sides(side);
  const BasicPixelBox<Lanes> box = broadcast(robot);
  Bounds out;
  for (int i = 0; i < kChildren; i += kLanes) {
    const Lanes u = u_begin + sides * load(kNodeGrid.column + i);
    const Lanes v = v_begin + sides * load(kNodeGrid.row + i);
    const BasicPixelBox<Lanes> child{
        u, u + sides, v, v + sides, load(node.depth_lo_m + i), load(node.depth_hi_m + i)};
    put(search, lower_bound_m2(search.metric, box, child, Lanes(search.max_gap_m)), i, out);
  }
  return out;
}

/// The bound of each robot tile of a node and an obstacle tile.
inline Bounds bound_robot_tiles(const Search& search, const RobotTiles::Node& node,
                                const PixelBox& obstacle) {
  const BasicPixelBox<Lanes> box = broadcast(obstacle);
  Bounds out;
  for (int i = 0; i < kChildren; i += kLanes) {
    const BasicPixelBox<Lanes> tile{load(node.u_lo + i),       load(node.u_hi + i),
                                    load(node.v_lo + i),       load(node.v_hi + i),
                                    load(node.depth_lo_m + i), load(node.depth_hi_m + i)};
    put(search, lower_bound_m2(search.metric, tile, box, Lanes(search.max_gap_m)), i, out);
  }
  return out;
}

/// Those of 16 that may improve on the best pair, nearest first.
struct Candidates {
  int count = 0;
  int index[kChildren];
};

inline Candidates nearest_first(const Bounds& bounds) {
  Candidates out;
  for (std::uint64_t bits = bounds.may_improve; bits != 0; bits &= bits - 1) {
    const int i = lowest_bit(bits);
    int place = out.count++;
    for (; place > 0 && bounds.squared_m2[i] < bounds.squared_m2[out.index[place - 1]]; --place) {
      out.index[place] = out.index[place - 1];
    }
    out.index[place] = i;
  }
  return out;
}

inline LeafTile obstacle_tile(const ObstacleTree& tree, Square square, int i) {
  const PixelBox box = child_box(tree, square, i);
  const std::size_t tile = index_of(tree, square) * kChildren + i;
  return {box, box.u_lo, box.v_lo, tree.tile_depth_m.data() + tile * kTilePixels};
}

inline LeafTile robot_tile(const RobotTiles& robot, const RobotTiles::Node& node, int i) {
  const RobotTiles::Tile& tile = robot.tiles[node.tile[i]];
  const PixelBox box{node.u_lo[i], node.u_hi[i],       node.v_lo[i],
                     node.v_hi[i], node.depth_lo_m[i], node.depth_hi_m[i]};
  return {box, tile.u, tile.v, tile.depth_m};
}

/// A robot node against the child `i`, a tile, of a square of the lowest level.
inline void search_tile(Search& search, const RobotTiles::Node& robot, Square square, int i) {
  const LeafTile obstacle = obstacle_tile(search.obstacles, square, i);
  const Bounds bounds = bound_robot_tiles(search, robot, obstacle.box);
  const Candidates near = nearest_first(bounds);
  for (int k = 0; k < near.count; ++k) {
    if (!(bounds.squared_m2[near.index[k]] < search.best.squared_m2)) return;
    search_leaf(search, robot_tile(search.robot, robot, near.index[k]), obstacle);
  }
}

/// A robot node against all below a square, nearest first.
void search_square(Search& search, const RobotTiles::Node& robot, Square square) {
  const Bounds bounds = bound_children(search, robot.box, square);
  const Candidates near = nearest_first(bounds);
  for (int k = 0; k < near.count; ++k) {
    const int i = near.index[k];
    if (!(bounds.squared_m2[i] < search.best.squared_m2)) return;
    if (square.level == 0) {
      search_tile(search, robot, square, i);
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
  Square square = root_of(search.obstacles);
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

std::int64_t search_nodes(const SearchInput& input, int last_node, ClosestPair& best) {
  Search search{
      broadcast(input.metric), input.robot, input.obstacles, best, max_gap_of(best.squared_m2), 0};
  int count = 0;
  for (int n = last_node; n >= 0; n = input.robot.nodes[n].next) {
    const float promise_m2 = promise_of(search, input.robot.nodes[n]);
    if (promise_m2 < HUGE_VALF) input.order[count++] = {promise_m2, n};
  }
  sort_by_bound(input.order, count);
  for (int k = 0; k < count; ++k) {
    search_square(search, input.robot.nodes[input.order[k].node], root_of(input.obstacles));
  }
  return search.pairs;
}

}  // namespace HWY_NAMESPACE
}  // namespace berth
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace berth {

HWY_EXPORT(search_nodes);

std::int64_t search_link(const SearchInput& input, int last_node, ClosestPair& best) {
  return HWY_DYNAMIC_DISPATCH(search_nodes)(input, last_node, best);
}

}  // namespace berth
#endif  // HWY_ONCE
