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
  out.may_improve |= bits_less(bound_m2, Lanes(search.limit_m2)) << i;
}

/// The bound of a robot box and each child of an obstacle square.
inline Bounds bound_children(const Search& search, const PixelBox& robot, Square square) {
  const ObstacleTree::Node& node = node_of(search.input.obstacles, square);
  const auto side = static_cast<float>(search.input.obstacles.levels[square.level].child_px);
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

inline LeafTile robot_tile(const Search& search, const RobotTiles::Node& node, int i,
                           TileCopy& copy) {
  const RobotTiles::Tile& tile = search.input.robot.tiles[node.tile[i]];
  const PixelBox box{node.u_lo[i], node.u_hi[i],       node.v_lo[i],
                     node.v_hi[i], node.depth_lo_m[i], node.depth_hi_m[i]};
  return {box, static_cast<float>(tile.u), static_cast<float>(tile.v),
          tile_depths(search.input.robot_depth_m, tile.u, tile.v, copy), tile.bits};
}

inline LeafTile obstacle_tile(const Search& search, const PixelBox& box, TileCopy& copy) {
  return {box, box.u_lo, box.v_lo,
          tile_depths(search.input.obstacle_depth_m, static_cast<int>(box.u_lo),
                      static_cast<int>(box.v_lo), copy),
          ~std::uint64_t{0}};
}

const AlignedTile& aligned_tile(Search& search, int i, const LeafTile& tile) {
  AlignedTile& out = search.aligned.tiles[i];
  if ((search.aligned.tiles_made >> i & 1) != 0) return out;
  search.aligned.tiles_made |= 1U << i;
  out.axes = axes_along(search.input.metric, fit_plane(tile), tile.u, tile.v);
  const AlignedView view(search.input.metric, out.axes, tile, {0, 0});
  out.box = view.box_of(~std::uint64_t{0});
  for (int q = 0; q < 4; ++q) out.quarters[q] = view.box_of(kQuarters[q]);
  return out;
}

/// The normal of a node's surface: the mean of a few of its tiles'.
Normal normal_of(const Search& search, const RobotTiles::Node& node) {
  constexpr int kSamples = 4;
  TileCopy copy;
  Normal sum;
  for (int k = 0; k < kSamples; ++k) {
    const int i = k * (node.tile_count - 1) / (kSamples - 1);
    const LeafTile tile = robot_tile(search, node, i, copy);
    add_normal(axes_along(search.input.metric, fit_plane(tile), tile.u, tile.v), sum);
  }
  return sum;
}

/// The direction of the closest pair so far.
Normal direction_of(const Metric& metric, const ClosestPair& pair) {
  const auto vector = berth::pair_vector(metric, pair.ru, pair.rv, pair.robot_depth_m, pair.ou,
                                         pair.ov, pair.obstacle_depth_m);
  return {vector.x_m, vector.y_m, vector.z_m};
}

void make_boxes(const Search& search, const RobotTiles::Node& node, const Normal& normal,
                AlignedBoxes& out) {
  out.is_made = true;
  out.axes = axes_of(normal);
  TileCopy copy;
  for (int i = 0; i < RobotTiles::kNodeTiles; ++i) {
    AlignedBox box{{HUGE_VALF, HUGE_VALF, HUGE_VALF}, {HUGE_VALF, HUGE_VALF, HUGE_VALF}};
    if (i < node.tile_count) {
      const LeafTile tile = robot_tile(search, node, i, copy);
      box = AlignedView(search.input.metric, out.axes, tile, {0, 0}).box_of(tile.bits);
    }
    for (int k = 0; k < 3; ++k) {
      out.lo_m[k][i] = box.lo_m[k];
      out.hi_m[k][i] = box.hi_m[k];
    }
  }
}

/// Sharpens the bounds of a robot node's tiles and an obstacle tile by boxes along the same axes.
void sharpen_along(const Search& search, const RobotTiles::Node& robot, const AlignedBoxes& aligned,
                   const LeafTile& obstacle, Bounds& bounds) {
  const AlignedView view(search.input.metric, aligned.axes, obstacle,
                         {robot.box.depth_lo_m, robot.box.depth_hi_m});
  const AlignedBox box = view.box_of(~std::uint64_t{0});
  bounds.may_improve = 0;
  for (int i = 0; i < kChildren; i += kLanes) {
    const Lanes bound_m2 =
        aligned_bound_m2(box, {aligned.lo_m[0] + i, aligned.lo_m[1] + i, aligned.lo_m[2] + i},
                         {aligned.hi_m[0] + i, aligned.hi_m[1] + i, aligned.hi_m[2] + i});
    put(search, greatest(load(bounds.squared_m2 + i), bound_m2), i, bounds);
  }
}

/// Along the robot's surface first, which is right where surfaces tie; then along the closest pair,
/// which is right where much of the robot lies before one plane.
void sharpen(Search& search, const RobotTiles::Node& robot, const LeafTile& obstacle,
             Bounds& bounds) {
  AlignedNode& aligned = search.aligned;
  if (!aligned.along_surface.is_made) {
    make_boxes(search, robot, normal_of(search, robot), aligned.along_surface);
  }
  sharpen_along(search, robot, aligned.along_surface, obstacle, bounds);
  if (bounds.may_improve == 0) return;
  if (!aligned.along_pair.is_made) {
    make_boxes(search, robot, direction_of(search.input.metric, search.best), aligned.along_pair);
  }
  sharpen_along(search, robot, aligned.along_pair, obstacle, bounds);
}

/// A robot node against one obstacle tile.
inline void search_tile(Search& search, const RobotTiles::Node& robot, const PixelBox& box) {
  Bounds bounds = bound_robot_tiles(search, robot, box);
  if (bounds.may_improve == 0) return;
  TileCopy obstacle_copy;
  const LeafTile obstacle = obstacle_tile(search, box, obstacle_copy);
  search.is_aligned |= search.best.ru >= 0 && work_of(search) >= search.align_at;
  if (search.is_aligned) sharpen(search, robot, obstacle, bounds);
  TileCopy robot_copy;
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

/// A node whose search takes more than this is aligned, which takes about as long.
constexpr std::int64_t kWorkBeforeAligned = 12000;

SearchResult search_nodes(const SearchInput& input, int last_node, const SearchLimits& limits,
                          ClosestPair& best) {
  AlignedNode aligned;
  Search search{input, limits, best, broadcast(input.metric), aligned};
  update_limit(search);
  const int count = order_nodes(search, last_node);
  int k = 0;
  for (; k < count && !search.stopped; ++k) {
    search.is_aligned = aligned.along_surface.is_made = aligned.along_pair.is_made = false;
    aligned.tiles_made = 0;
    search.align_at = work_of(search) + (limits.tolerance_m > 0 ? 0 : kWorkBeforeAligned);
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
