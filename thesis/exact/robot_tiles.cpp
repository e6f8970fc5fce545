#include "thesis/exact/robot_tiles.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstdint>

#include "thesis/exact/link_tile.hpp"
#include "thesis/exact/tile_bits.hpp"

// Compiles the rest of this file once for each instruction set.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "thesis/exact/robot_tiles.cpp"
#include "hwy/foreach_target.h"

#include "thesis/tile_lanes-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace berth {
namespace HWY_NAMESPACE {

constexpr int kSquarePx = 4 * kTilePx;

using IdTag = hn::CappedTag<LinkId, 32>;
constexpr int kIdLanes = static_cast<int>(hn::MaxLanes(IdTag()));

/// Bit c is set where tile c of a square of 32 x 32 ids has any that is not kNoLink.
HWY_INLINE std::uint32_t tiles_with_ids(const LinkId* ids, std::ptrdiff_t stride) {
  std::uint32_t tiles = 0;
  for (int row = 0; row < 4; ++row) {
    std::uint64_t columns = 0;
    for (int u = 0; u < kSquarePx; u += kIdLanes) {
      auto any = hn::Zero(IdTag());
      for (int v = row * kTilePx; v < (row + 1) * kTilePx; ++v) {
        any = hn::Or(any, hn::LoadU(IdTag(), ids + v * stride + u));
      }
      columns |= bits_of(IdTag(), hn::Ne(any, hn::Zero(IdTag()))) << u;
    }
    for (int c = 0; c < 4; ++c) {
      if ((columns >> (c * kTilePx) & 0xFF) != 0) tiles |= 1U << (4 * row + c);
    }
  }
  return tiles;
}

/// The ids of a tile.
struct TileIds {
  static constexpr int kVectors = kTilePixels / kIdLanes;
  hn::Vec<IdTag> ids[kVectors];

  HWY_INLINE TileIds(const LinkId* corner, std::ptrdiff_t stride) {
    for (int i = 0; i < kVectors; ++i) ids[i] = load_rows(corner, i, stride);
  }

  /// The pixels that show this id.
  HWY_INLINE std::uint64_t pixels_of(LinkId id) const {
    std::uint64_t bits = 0;
    for (int i = 0; i < kVectors; ++i) {
      bits |= bits_of(IdTag(), hn::Eq(ids[i], hn::Set(IdTag(), id))) << (i * kIdLanes);
    }
    return bits;
  }

 private:
  /// Vector i of the tile by rows; a vector holds part of a row or several rows.
  static HWY_INLINE hn::Vec<IdTag> load_rows(const LinkId* corner, int i, std::ptrdiff_t stride) {
    const int first = i * kIdLanes;
    const LinkId* x = corner + first / kTilePx * stride + first % kTilePx;
#if HWY_TARGET == HWY_SCALAR
    return hn::LoadU(IdTag(), x);
#else
    if constexpr (kIdLanes <= kTilePx) {
      return hn::LoadU(IdTag(), x);
    } else {
      const hn::Half<IdTag> two;
      if constexpr (kIdLanes == 2 * kTilePx) {
        return hn::Combine(IdTag(), hn::LoadU(two, x + stride), hn::LoadU(two, x));
      } else {
        const hn::Half<decltype(two)> one;
        return hn::Combine(
            IdTag(),
            hn::Combine(two, hn::LoadU(one, x + 3 * stride), hn::LoadU(one, x + 2 * stride)),
            hn::Combine(two, hn::LoadU(one, x + stride), hn::LoadU(one, x)));
      }
    }
#endif
  }
};

HWY_INLINE void find_depth_range(LinkTile& tile, const DepthSquare& depths) {
  Lanes lo(HUGE_VALF);
  Lanes hi(-HUGE_VALF);
  for (int i = 0; i < kTilePixels; i += kLanes) {
    const Lanes x = keep_where(tile.bits >> i, load_tile(depths, i));
    lo = lesser_or_first(lo, x);
    hi = greater_or_first(hi, x);
  }
  tile.depth_lo_m = least_lane(lo);
  tile.depth_hi_m = greatest_lane(hi);
}

/// Splits one tile by links. Returns how many there are.
HWY_INLINE int split_tile(const LinkId* corner, const DepthSquare& depths, int tile,
                          LinkTile* out) {
  const TileIds ids(corner, depths.stride);
  int count = 0;
  std::uint64_t rest = ~(ids.pixels_of(kNoLink) | ids.pixels_of(kEnvironmentLink));
  while (rest != 0) {
    const int first = lowest_bit(rest);
    LinkTile& found = out[count++];
    found.id = corner[first / kTilePx * depths.stride + first % kTilePx];
    found.tile = tile;
    found.bits = ids.pixels_of(found.id);
    found.pixels = __builtin_popcountll(found.bits);
    find_depth_range(found, depths);
    rest &= ~found.bits;
  }
  return count;
}

/// Splits 32 x 32 pixels, all of which can be read, by tiles and links. Returns how many there are.
int split_square(const LinkId* ids, const float* depth_m, std::ptrdiff_t stride, LinkTile* out) {
  int count = 0;
  for (std::uint64_t tiles = tiles_with_ids(ids, stride); tiles != 0; tiles &= tiles - 1) {
    const int tile = lowest_bit(tiles);
    const std::ptrdiff_t corner = tile / 4 * kTilePx * stride + tile % 4 * kTilePx;
    count += split_tile(ids + corner, {depth_m + corner, stride}, tile, out + count);
  }
  return count;
}

}  // namespace HWY_NAMESPACE
}  // namespace berth
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace berth {

HWY_EXPORT(split_square);

namespace {

constexpr int kSquarePx = 4 * kTilePx;

/// A copy of a square that the image's border cuts, with no robot beyond it.
struct SquareCopy {
  LinkId ids[kSquarePx * kSquarePx];
  float depth_m[kSquarePx * kSquarePx];
};

void copy_square(const RobotImage& robot, int u, int v, SquareCopy& copy) {
  const int width = std::min(kSquarePx, robot.link_id.width() - u);
  const int height = std::min(kSquarePx, robot.link_id.height() - v);
  std::fill_n(copy.ids, kSquarePx * kSquarePx, kNoLink);
  std::fill_n(copy.depth_m, kSquarePx * kSquarePx, kNoDepth);
  for (int row = 0; row < height; ++row) {
    std::copy_n(robot.link_id.row(v + row) + u, width, copy.ids + row * kSquarePx);
    std::copy_n(robot.depth_m.row(v + row) + u, width, copy.depth_m + row * kSquarePx);
  }
}

int split_square_at(const RobotImage& robot, int u, int v, LinkTile* out) {
  const auto split = HWY_DYNAMIC_DISPATCH(split_square);
  const int width = robot.link_id.width();
  if (u + kSquarePx <= width && v + kSquarePx <= robot.link_id.height()) {
    return split(robot.link_id.row(v) + u, robot.depth_m.row(v) + u, width, out);
  }
  SquareCopy copy;
  copy_square(robot, u, v, copy);
  return split(copy.ids, copy.depth_m, kSquarePx, out);
}

void start_node(RobotTiles::Node& node, int next) {
  node.tile_count = 0;
  node.next = next;
  node.box = {HUGE_VALF, -HUGE_VALF, HUGE_VALF, -HUGE_VALF, HUGE_VALF, -HUGE_VALF};
  for (float* side : {node.u_lo, node.u_hi, node.v_lo, node.v_hi}) {
    std::fill_n(side, RobotTiles::kNodeTiles, 0.0f);
  }
  std::fill_n(node.depth_lo_m, RobotTiles::kNodeTiles, HUGE_VALF);
  std::fill_n(node.depth_hi_m, RobotTiles::kNodeTiles, -HUGE_VALF);
}

void append(const PixelBox& box, int tile, RobotTiles::Node& node) {
  const int i = node.tile_count++;
  node.tile[i] = tile;
  node.u_lo[i] = box.u_lo;
  node.u_hi[i] = box.u_hi;
  node.v_lo[i] = box.v_lo;
  node.v_hi[i] = box.v_hi;
  node.depth_lo_m[i] = box.depth_lo_m;
  node.depth_hi_m[i] = box.depth_hi_m;
  node.box = {std::min(node.box.u_lo, box.u_lo),
              std::max(node.box.u_hi, box.u_hi),
              std::min(node.box.v_lo, box.v_lo),
              std::max(node.box.v_hi, box.v_hi),
              std::min(node.box.depth_lo_m, box.depth_lo_m),
              std::max(node.box.depth_hi_m, box.depth_hi_m)};
}

/// Adds a tile of the square at (u, v), whose first node is square_begin.
void add_tile(const LinkTile& found, int u, int v, int square_begin, RobotTiles& out) {
  assert(found.id <= out.links.size());
  RobotTiles::Link& link = out.links[found.id - 1];
  link.pixels += found.pixels;
  if (link.last_node < square_begin) {
    start_node(out.nodes.emplace_back(), link.last_node);
    link.last_node = static_cast<int>(out.nodes.size()) - 1;
    ++link.node_count;
  }
  const RobotTiles::Tile tile{found.bits, u + found.tile % 4 * kTilePx,
                              v + found.tile / 4 * kTilePx};
  out.tiles.push_back(tile);
  PixelBox box = box_of_bits(tile.bits, static_cast<float>(tile.u), static_cast<float>(tile.v));
  box.depth_lo_m = found.depth_lo_m;
  box.depth_hi_m = found.depth_hi_m;
  append(box, static_cast<int>(out.tiles.size()) - 1, out.nodes[link.last_node]);
}

}  // namespace

void build_robot_tiles(const RobotImage& robot, int link_count, RobotTiles& out) {
  out.tiles.clear();
  out.nodes.clear();
  out.links.assign(link_count, {});
  LinkTile found[kSquarePx * kSquarePx];
  const PixelRect extent = clip(robot.extent, robot.link_id.width(), robot.link_id.height());
  for (int v = extent.v_begin / kSquarePx * kSquarePx; v < extent.v_end; v += kSquarePx) {
    for (int u = extent.u_begin / kSquarePx * kSquarePx; u < extent.u_end; u += kSquarePx) {
      const int count = split_square_at(robot, u, v, found);
      const int square_begin = static_cast<int>(out.nodes.size());
      for (int i = 0; i < count; ++i) add_tile(found[i], u, v, square_begin, out);
    }
  }
}

}  // namespace berth
#endif  // HWY_ONCE
