// What a search that turns out to be long does to sharpen its bounds: it looks along surfaces.
#if defined(BERTH_DISTANCE_EXACT_SHARPEN_INL_HPP) == defined(HWY_TARGET_TOGGLE)
#ifdef BERTH_DISTANCE_EXACT_SHARPEN_INL_HPP
#undef BERTH_DISTANCE_EXACT_SHARPEN_INL_HPP
#else
#define BERTH_DISTANCE_EXACT_SHARPEN_INL_HPP
#endif

#include "thesis/exact/bounds-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace berth {
namespace HWY_NAMESPACE {

inline LeafTile robot_tile(const Search& search, const RobotTiles::Node& node, int i,
                           DepthSquareCopy<kTilePx>& copy) {
  const RobotTiles::Tile& tile = search.input.robot.tiles[node.tile[i]];
  const PixelBox box{node.u_lo[i], node.u_hi[i],       node.v_lo[i],
                     node.v_hi[i], node.depth_lo_m[i], node.depth_hi_m[i]};
  return {box, static_cast<float>(tile.u), static_cast<float>(tile.v),
          depth_square<kTilePx>(search.input.robot_depth_m, tile.u, tile.v, copy), tile.bits};
}

inline LeafTile obstacle_tile(const Search& search, const PixelBox& box,
                              DepthSquareCopy<kTilePx>& copy) {
  return {box, box.u_lo, box.v_lo,
          depth_square<kTilePx>(search.input.obstacle_depth_m, static_cast<int>(box.u_lo),
                                static_cast<int>(box.v_lo), copy),
          ~std::uint64_t{0}};
}

inline const AlignedTile& aligned_tile(Search& search, int i, const LeafTile& tile) {
  AlignedTile& out = search.aligned.tiles[i];
  if ((search.aligned.tiles_made >> i & 1) != 0) return out;
  search.aligned.tiles_made |= 1U << i;
  out.axes = axes_along(search.input.metric, fit_plane(tile), tile.u, tile.v);
  const AlignedCamera view(search.input.metric, out.axes, tile, {0, 0});
  out.box = view.box_of(~std::uint64_t{0});
  for (int q = 0; q < 4; ++q) out.quarters[q] = view.box_of(kQuarters[q]);
  return out;
}

/// The direction of the closest pair so far.
inline Normal direction_of(const Metric& metric, const ClosestPair& pair) {
  const auto vector = berth::pair_vector(metric, pair.ru, pair.rv, pair.robot_depth_m, pair.ou,
                                         pair.ov, pair.obstacle_depth_m);
  return {vector.x_m, vector.y_m, vector.z_m};
}

inline void make_boxes(const Search& search, const RobotTiles::Node& node, AlignedBoxes& out) {
  out.is_made = true;
  out.axes = axes_of(search.input.metric, direction_of(search.input.metric, search.best));
  DepthSquareCopy<kTilePx> copy;
  for (int i = 0; i < RobotTiles::kNodeTiles; ++i) {
    AlignedBox box{{HUGE_VALF, HUGE_VALF, HUGE_VALF}, {HUGE_VALF, HUGE_VALF, HUGE_VALF}};
    if (i < node.tile_count) {
      const LeafTile tile = robot_tile(search, node, i, copy);
      box = AlignedCamera(search.input.metric, out.axes, tile, {0, 0}).box_of(tile.bits);
    }
    for (int k = 0; k < 3; ++k) {
      out.lo_m[k][i] = box.lo_m[k];
      out.hi_m[k][i] = box.hi_m[k];
    }
  }
}

/// Sharpens the bounds of a robot node's tiles and an obstacle tile by boxes along the closest pair
/// so far.
inline void sharpen(Search& search, const RobotTiles::Node& robot, const LeafTile& obstacle,
                    Bounds& bounds) {
  AlignedBoxes& boxes = search.aligned.boxes;
  if (!boxes.is_made) make_boxes(search, robot, boxes);
  const AlignedCamera view(search.input.metric, boxes.axes, obstacle,
                           {robot.box.depth_lo_m, robot.box.depth_hi_m});
  const AlignedBox box = view.box_of(~std::uint64_t{0});
  bounds.may_improve = 0;
  for (int i = 0; i < kNodeChildren; i += kLanes) {
    const Lanes bound_m2 =
        aligned_bound_m2(box, {boxes.lo_m[0] + i, boxes.lo_m[1] + i, boxes.lo_m[2] + i},
                         {boxes.hi_m[0] + i, boxes.hi_m[1] + i, boxes.hi_m[2] + i});
    put(search, greatest(load(bounds.squared_m2 + i), bound_m2), i, bounds);
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace berth
HWY_AFTER_NAMESPACE();

#endif
