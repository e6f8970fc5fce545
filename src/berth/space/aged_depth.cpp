#include "berth/space/aged_depth.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

#include "berth/space/far_reaching.hpp"
#include "berth/space/least_of_rows.hpp"

#ifndef BERTH_AGED_DEPTH_RINGS
#define BERTH_AGED_DEPTH_RINGS
namespace berth {
/// What lies beside a row on either side, so that it can be spread in place: two vectors, and twice
/// as much as the greatest ring reaches to both sides.
constexpr int kMargin = 128;
/// Which rings occur is known for so many pixels of a row at once.
constexpr int kBlock_px = 64;
}  // namespace berth
#endif

// Compiles the rest of this file once for each instruction set.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "berth/space/aged_depth.cpp"
#include "hwy/foreach_target.h"

#include "berth/space/rows-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace berth {
namespace HWY_NAMESPACE {

using ByteTag = hn::Rebind<std::uint8_t, FloatTag>;
using NumberTag = hn::Rebind<std::int32_t, FloatTag>;

/// How many of the borders some readings lie before. Returns a bit for each number that occurs.
HWY_INLINE std::uint32_t count_in_block(const float* sensed_m, const float* borders_m, int count,
                                        int width, std::uint8_t* out) {
  std::uint32_t found = 0;
  const auto one = [&](int u) {
    int number = 0;
    while (number < count && sensed_m[u] < borders_m[number]) ++number;
    out[u] = static_cast<std::uint8_t>(number);
    found |= 1u << number;
  };
  for_row(
      0, width,
      [&](int u) HWY_ATTR {
        const Lanes sensed = load(sensed_m + u);
        Lanes numbers(0.0f);
        std::uint64_t before = bits_of(Lanes(0.0f) <= Lanes(0.0f));
        for (int i = 0; i < count; ++i) {
          const LaneMask is_before = sensed < Lanes(borders_m[i]);
          const std::uint64_t bits = bits_of(is_before);
          if (bits != before) found |= 1u << i;
          before = bits;
          if (bits == 0) break;
          numbers = numbers + hn::IfThenElseZero(is_before, Lanes(1.0f).v);
        }
        if (before != 0) found |= 1u << count;
        hn::StoreU(hn::DemoteTo(ByteTag(), hn::ConvertTo(NumberTag(), numbers.v)), ByteTag(),
                   out + u);
      },
      one);
  return found;
}

/// The same for a row, with the bits of each kBlock_px of it.
void count_borders(const float* sensed_m, const float* borders_m, int count, int width,
                   std::uint8_t* out, std::uint32_t* found) {
  for (int u = 0; u < width; u += kBlock_px) {
    *found++ =
        count_in_block(sensed_m + u, borders_m, count, std::min(kBlock_px, width - u), out + u);
  }
}

/// What the pixels with this reach have left, the greatest float elsewhere.
void take_ring(const float* own_m, const std::uint8_t* reach, int ring, float moved_m, int width,
               float* out) {
  const auto wanted = hn::Set(NumberTag(), ring);
  for_row(
      0, width,
      [&](int u) {
        const auto numbers = hn::PromoteTo(NumberTag(), hn::LoadU(ByteTag(), reach + u));
        const LaneMask is_wanted = hn::RebindMask(FloatTag(), hn::Eq(numbers, wanted));
        const Lanes left = greatest(load(own_m + u) - Lanes(moved_m), Lanes(0.0f));
        store(select(is_wanted, left, Lanes(kHoldsNothing_m)), out + u);
      },
      [&](int u) {
        out[u] = reach[u] == ring ? std::max(0.0f, own_m[u] - moved_m) : kHoldsNothing_m;
      });
}

/// x[i] becomes the least of x[i] to x[i + 2 reach] for i in [-2 reach, width); kMargin numbers are
/// there on either side.
void spread_in_row(float* x, int reach, int width) {
  int side = 1;
  const int wanted = 2 * reach + 1;
  const int begin = -2 * reach;
  const int end = width + 2 * reach;
  for (; 2 * side <= wanted; side *= 2) {
    for (int i = begin; i < end; i += kLanes) store(least(load(x + i), load(x + i + side)), x + i);
  }
  const int last = wanted - side;
  for (int i = begin; i < end; i += kLanes) store(least(load(x + i), load(x + i + last)), x + i);
}

}  // namespace HWY_NAMESPACE
}  // namespace berth
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace berth {

HWY_EXPORT(count_borders);
HWY_EXPORT(take_ring);
HWY_EXPORT(spread_in_row);

namespace {

int blocks_of(int width) { return (width + kBlock_px - 1) / kBlock_px; }

/// Writes workspace.reach and .reaches; returns all reaches that occur, a bit each.
std::uint32_t find_reaches(const Reach& reach, const DepthImage& sensor_depth_m,
                           AgingWorkspace& workspace) {
  const int width = sensor_depth_m.width();
  const int height = sensor_depth_m.height();
  if (workspace.reach.width() != width || workspace.reach.height() != height) {
    workspace.reach.resize(width, height, 0);
  }
  const int blocks = blocks_of(width);
  workspace.reaches.resize(static_cast<std::size_t>(blocks) * height);
  for (int v = 0; v < height; ++v) {
    HWY_DYNAMIC_DISPATCH(count_borders)
    (sensor_depth_m.row(v), reach.borders_m(), kMostRing + 1, width, workspace.reach.row(v),
     &workspace.reaches[static_cast<std::size_t>(blocks) * v]);
  }
  std::uint32_t all = 0;
  for (const std::uint32_t some : workspace.reaches) all |= some;
  return all;
}

constexpr std::uint32_t kFarBit = 1u << (kMostRing + 1);

/// The others: what a pixel of reach r has left is spread along its row by r at once, and then from
/// ring r to ring r - 1 by one row up and down, until ring 0 has all. All rings go down the image
/// together, each a row behind the next greater one, so that of each only three rows are kept. Of a
/// row only that part is touched to which a ring's pixels reach.
class Rings {
 public:
  Rings(const DepthImage& own_m, float moved_m, int greatest, AgingWorkspace& workspace)
      : own_m_(own_m),
        moved_m_(moved_m),
        greatest_(greatest),
        workspace_(workspace),
        width_(own_m.width()),
        height_(own_m.height()) {
    workspace.rows.assign(std::size_t(3 * (greatest + 1) + 1) * width_ + 2 * kMargin,
                          kHoldsNothing_m);
    workspace.parts.assign(std::size_t(3 * (greatest + 1)), {});
    find_ring_blocks(blocks_of(width_));
  }

  void run(DepthImage& out) {
    for (int step = 0; step < height_ + greatest_; ++step) {
      for (int ring = greatest_; ring >= 0; --ring) {
        const int v = step - (greatest_ - ring);
        if (v >= 0 && v < height_) fill(ring, v, ring == 0 ? out.row(v) : row(ring, v));
      }
    }
  }

 private:
  using Part = AgingWorkspace::Part;

  std::size_t slot(int ring, int v) const { return std::size_t(3 * ring + v % 3); }
  float* row(int ring, int v) { return workspace_.rows.data() + slot(ring, v) * width_; }
  float* scratch() {
    return workspace_.rows.data() + std::size_t(3 * (greatest_ + 1)) * width_ + kMargin;
  }

  void fill(int ring, int v, float* out) {
    Part& kept = workspace_.parts[slot(ring, v)];
    // The image's row had other content before.
    const Part before = ring == 0 ? Part{0, width_} : kept;
    const Part beyond = ring < greatest_ ? take_rings_beyond(ring + 1, v, out) : Part{};
    const Part pixels = pixels_of(ring, v);
    const Part reached = pixels.is_empty() ? Part{}
                                           : Part{std::max(pixels.begin - ring, 0),
                                                  std::min(pixels.end + ring, width_)};
    kept = join(beyond, reached);
    // Nothing is there outside of what is beyond.
    clear_beside(beyond, join(before, kept), out);
    if (pixels.is_empty()) return;
    const float* const spread = spread_own(ring, v, pixels);
    take_least(spread + reached.begin, reached.end - reached.begin, out + reached.begin);
  }

  /// Columns of `all` that are not among those of `filled`, which lies in it or is empty.
  static void clear_beside(const Part& filled, const Part& all, float* out) {
    const int middle = filled.is_empty() ? all.end : filled.begin;
    fill_endless(middle - all.begin, out + all.begin);
    if (!filled.is_empty()) fill_endless(all.end - filled.end, out + filled.end);
  }

  static Part join(const Part& a, const Part& b) {
    if (a.is_empty()) return b;
    if (b.is_empty()) return a;
    return {std::min(a.begin, b.begin), std::max(a.end, b.end)};
  }

  /// What the next greater ring has around the row, one row up and down.
  Part take_rings_beyond(int ring, int v, float* out) {
    const float* rows[3];
    Part part;
    for (int i = 0; i < 3; ++i) {
      const int y = std::clamp(v - 1 + i, 0, height_ - 1);
      rows[i] = row(ring, y);
      part = join(part, workspace_.parts[slot(ring, y)]);
    }
    if (part.is_empty()) return part;
    for (const float*& from : rows) from += part.begin;
    take_least_of(rows, part.end - part.begin, out + part.begin);
    return part;
  }

  /// Where in the row pixels of this ring are.
  Part pixels_of(int ring, int v) const {
    const AgingWorkspace::Blocks& blocks =
        workspace_.ring_blocks[std::size_t(greatest_ + 1) * v + ring];
    return {blocks.begin * kBlock_px, std::min(blocks.end * kBlock_px, width_)};
  }

  /// Writes workspace.ring_blocks.
  void find_ring_blocks(int blocks) {
    workspace_.ring_blocks.assign(std::size_t(greatest_ + 1) * height_, {});
    const std::uint32_t rings = (std::uint32_t{2} << greatest_) - 1;
    for (int v = 0; v < height_; ++v) {
      AgingWorkspace::Blocks* const of_row =
          &workspace_.ring_blocks[std::size_t(greatest_ + 1) * v];
      for (int i = 0; i < blocks; ++i) {
        std::uint32_t found = workspace_.reaches[std::size_t(blocks) * v + i] & rings;
        for (; found != 0; found &= found - 1) {
          AgingWorkspace::Blocks& of_ring = of_row[std::countr_zero(found)];
          if (of_ring.end == 0) of_ring.begin = static_cast<std::int16_t>(i);
          of_ring.end = static_cast<std::int16_t>(i + 1);
        }
      }
    }
  }

  /// What these pixels hold of the row; of others nothing is said.
  const float* spread_own(int ring, int v, const Part& pixels) {
    float* const x = scratch() + pixels.begin;
    const int count = pixels.end - pixels.begin;
    HWY_DYNAMIC_DISPATCH(take_ring)
    (own_m_.row(v) + pixels.begin, workspace_.reach.row(v) + pixels.begin, ring, moved_m_, count,
     x);
    if (ring > 0) {
      fill_endless(kMargin, x - kMargin);
      fill_endless(kMargin, x + count);
      HWY_DYNAMIC_DISPATCH(spread_in_row)(x, ring, count);
    }
    return scratch() - ring;
  }

  const DepthImage& own_m_;
  float moved_m_;
  int greatest_;
  AgingWorkspace& workspace_;
  int width_;
  int height_;
};

}  // namespace

void age_own_free_depth(const Camera& camera, const DepthImage& sensor_depth_m,
                        const DepthImage& own_m, double moved_m, AgingWorkspace& workspace,
                        DepthImage& out) {
  const int width = own_m.width();
  const int height = own_m.height();
  if (out.width() != width || out.height() != height) out.resize(width, height, 0);
  if (width == 0 || height == 0) return;
  const Reach reach(camera, moved_m);
  const auto moved = static_cast<float>(moved_m);
  const std::uint32_t reaches = find_reaches(reach, sensor_depth_m, workspace);
  const std::uint32_t in_rings = reaches & (kFarBit - 1);
  Rings(own_m, moved, std::bit_width(in_rings | 1) - 1, workspace).run(out);
  if ((reaches & kFarBit) != 0) {
    hold_far_reaching(reach, sensor_depth_m, own_m, moved, workspace, out);
  }
}

}  // namespace berth
#endif  // HWY_ONCE
