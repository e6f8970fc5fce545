// Bounds of 16 boxes at a time: the children of an obstacle square, or the tiles of a robot node.
#if defined(BERTH_DISTANCE_EXACT_BOUNDS_INL_HPP) == defined(HWY_TARGET_TOGGLE)
#ifdef BERTH_DISTANCE_EXACT_BOUNDS_INL_HPP
#undef BERTH_DISTANCE_EXACT_BOUNDS_INL_HPP
#else
#define BERTH_DISTANCE_EXACT_BOUNDS_INL_HPP
#endif

#include "thesis/exact/state-inl.hpp"
#include "thesis/exact/tile_bits.hpp"
#include "thesis/grid.hpp"

HWY_BEFORE_NAMESPACE();
namespace berth {
namespace HWY_NAMESPACE {

constexpr int kNodeChildren = ObstacleTree::kChildren;

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
  alignas(64) float squared_m2[kNodeChildren];
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
  for (int i = 0; i < kNodeChildren; i += kLanes) {
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
  for (int i = 0; i < kNodeChildren; i += kLanes) {
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
  int index[kNodeChildren];
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

}  // namespace HWY_NAMESPACE
}  // namespace berth
HWY_AFTER_NAMESPACE();

#endif
