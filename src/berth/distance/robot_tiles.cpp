#include "berth/distance/robot_tiles.hpp"

#include <algorithm>
#include <bit>
#include <cassert>
#include <cmath>
#include <cstdint>

#include "berth/distance/tile_bits.hpp"

// Compiles the rest of this file once for each instruction set.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "berth/distance/robot_tiles.cpp"
#include "hwy/foreach_target.h"

#include "berth/distance/lanes-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace berth {
namespace HWY_NAMESPACE {

constexpr int kTilePx = RobotTiles::kTilePx;
constexpr int kTilePixels = RobotTiles::kTilePixels;
constexpr int kSquarePx = 4 * kTilePx;

using IdTag = hn::CappedTag<LinkId, 32>;
constexpr int kIdLanes = static_cast<int>(hn::MaxLanes(IdTag()));

template <class Mask>
HWY_INLINE std::uint64_t bits_of(Mask mask) {
  std::uint64_t bits = 0;
  hn::StoreMaskBits(IdTag(), mask, reinterpret_cast<std::uint8_t*>(&bits));
  return bits;
}

/// Bit c is set where tile c of a square of 32 x 32 ids has any that is not kNoLink.
std::uint32_t tiles_with_ids(const LinkId* ids, std::ptrdiff_t stride) {
  std::uint32_t tiles = 0;
  for (int row = 0; row < 4; ++row) {
    std::uint64_t columns = 0;
    for (int u = 0; u < kSquarePx; u += kIdLanes) {
      auto any = hn::Zero(IdTag());
      for (int v = row * kTilePx; v < (row + 1) * kTilePx; ++v) {
        any = hn::Or(any, hn::LoadU(IdTag(), ids + v * stride + u));
      }
      columns |= bits_of(hn::Ne(any, hn::Zero(IdTag()))) << u;
    }
    for (int c = 0; c < 4; ++c) {
      if ((columns >> (c * kTilePx) & 0xFF) != 0) tiles |= 1U << (4 * row + c);
    }
  }
  return tiles;
}

/// The pixels of a tile that show this id.
std::uint64_t pixels_of(const LinkId* ids, LinkId id) {
  std::uint64_t bits = 0;
  for (int i = 0; i < kTilePixels; i += kIdLanes) {
    bits |= bits_of(hn::Eq(hn::LoadU(IdTag(), ids + i), hn::Set(IdTag(), id))) << i;
  }
  return bits;
}

/// Copies the depths of the pixels in `bits`, NaN elsewhere, and gives their range.
void copy_depths(std::uint64_t bits, const float* depth_m, float* link_depth_m, float* lo_m,
                 float* hi_m) {
  Lanes lo(HUGE_VALF);
  Lanes hi(-HUGE_VALF);
  for (int i = 0; i < kTilePixels; i += kLanes) {
    const Lanes x = load_where(bits >> i, depth_m + i);
    store(x, link_depth_m + i);
    lo = lesser_or_first(lo, x);
    hi = greater_or_first(hi, x);
  }
  *lo_m = least_lane(lo);
  *hi_m = greatest_lane(hi);
}

}  // namespace HWY_NAMESPACE
}  // namespace berth
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace berth {

HWY_EXPORT(tiles_with_ids);
HWY_EXPORT(pixels_of);
HWY_EXPORT(copy_depths);

namespace {

constexpr int kTilePx = RobotTiles::kTilePx;
constexpr int kTilePixels = RobotTiles::kTilePixels;
constexpr int kSquarePx = 4 * kTilePx;

/// 32 x 32 pixels of the robot image, with the first one at (u, v).
struct Square {
  int u;
  int v;
  ImageView<LinkId> ids;
  DepthView depth_m;
};

/// 8 x 8 pixels by rows.
struct SquareTile {
  float u;
  float v;
  alignas(64) LinkId ids[kTilePixels];
  alignas(64) float depth_m[kTilePixels];
};

/// What pads a square that the image's border cuts.
struct Padding {
  LinkId ids[kSquarePx * kSquarePx];
  float depth_m[kSquarePx * kSquarePx];
};

Square square_at(const RobotImage& robot, int u, int v, Padding& padding) {
  const int width = std::min(kSquarePx, robot.link_id.width() - u);
  const int height = std::min(kSquarePx, robot.link_id.height() - v);
  if (width == kSquarePx && height == kSquarePx) {
    const int stride = robot.link_id.width();
    return {u,
            v,
            {robot.link_id.row(v) + u, width, height, stride},
            {robot.depth_m.row(v) + u, width, height, stride}};
  }
  std::fill_n(padding.ids, kSquarePx * kSquarePx, kNoLink);
  std::fill_n(padding.depth_m, kSquarePx * kSquarePx, kNoDepth);
  for (int row = 0; row < height; ++row) {
    std::copy_n(robot.link_id.row(v + row) + u, width, padding.ids + row * kSquarePx);
    std::copy_n(robot.depth_m.row(v + row) + u, width, padding.depth_m + row * kSquarePx);
  }
  return {u,
          v,
          {padding.ids, kSquarePx, kSquarePx, kSquarePx},
          {padding.depth_m, kSquarePx, kSquarePx, kSquarePx}};
}

void read_tile(const Square& square, int c, SquareTile& tile) {
  const int u = c % 4 * kTilePx;
  const int v = c / 4 * kTilePx;
  tile.u = static_cast<float>(square.u + u);
  tile.v = static_cast<float>(square.v + v);
  for (int row = 0; row < kTilePx; ++row) {
    std::copy_n(square.ids.row(v + row) + u, kTilePx, tile.ids + row * kTilePx);
    std::copy_n(square.depth_m.row(v + row) + u, kTilePx, tile.depth_m + row * kTilePx);
  }
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

/// Adds the pixels `bits` of one link. `square_begin` is the first node of the present square.
void add_link_tile(const SquareTile& tile, std::uint64_t bits, LinkId id, int square_begin,
                   RobotTiles& out) {
  RobotTiles::Link& link = out.links[id - 1];
  link.pixels += std::popcount(bits);
  if (link.last_node < square_begin) {
    start_node(out.nodes.emplace_back(), link.last_node);
    link.last_node = static_cast<int>(out.nodes.size()) - 1;
  }
  RobotTiles::Tile& link_tile = out.tiles.emplace_back();
  link_tile.u = tile.u;
  link_tile.v = tile.v;
  PixelBox box = box_of_bits(bits, tile.u, tile.v);
  HWY_DYNAMIC_DISPATCH(copy_depths)
  (bits, tile.depth_m, link_tile.depth_m, &box.depth_lo_m, &box.depth_hi_m);
  append(box, static_cast<int>(out.tiles.size()) - 1, out.nodes[link.last_node]);
}

void add_tile(const SquareTile& tile, int square_begin, RobotTiles& out) {
  const auto find = HWY_DYNAMIC_DISPATCH(pixels_of);
  std::uint64_t rest = ~(find(tile.ids, kNoLink) | find(tile.ids, kEnvironmentLink));
  while (rest != 0) {
    const LinkId id = tile.ids[lowest_bit(rest)];
    assert(id <= out.links.size());
    const std::uint64_t bits = find(tile.ids, id);
    add_link_tile(tile, bits, id, square_begin, out);
    rest &= ~bits;
  }
}

void add_square(const Square& square, RobotTiles& out) {
  const int square_begin = static_cast<int>(out.nodes.size());
  std::uint64_t tiles = HWY_DYNAMIC_DISPATCH(tiles_with_ids)(square.ids.data, square.ids.stride);
  SquareTile tile;
  for (; tiles != 0; tiles &= tiles - 1) {
    read_tile(square, lowest_bit(tiles), tile);
    add_tile(tile, square_begin, out);
  }
}

}  // namespace

void build_robot_tiles(const RobotImage& robot, int link_count, RobotTiles& out) {
  out.tiles.clear();
  out.nodes.clear();
  out.links.assign(link_count, {});
  Padding padding;
  for (int v = 0; v < robot.link_id.height(); v += kSquarePx) {
    for (int u = 0; u < robot.link_id.width(); u += kSquarePx) {
      add_square(square_at(robot, u, v, padding), out);
    }
  }
}

}  // namespace berth
#endif  // HWY_ONCE
