#include "berth/space/aged_depth.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <memory>

#include "berth/space/far_reaching.hpp"
#include "berth/space/least_of_rows.hpp"
#include "berth/vector/divide_up.hpp"

#ifndef BERTH_AGED_DEPTH_RINGS
#define BERTH_AGED_DEPTH_RINGS
namespace berth {
/// What lies beside a row on either side: four vectors, and as much as the greatest ring reaches.
constexpr int kMargin = 128;
/// Rows begin at a multiple of so many numbers, the most that a vector has.
constexpr int kAlign = 16;
/// Which rings occur is known for so many pixels of a row at once.
constexpr int kBlock_px = 64;

/// What a ring's row is made of.
struct RingRow {
  /// The next greater ring's rows above, beside and below, from column 0 on; null where it has
  /// nothing there.
  const float* beyond[3] = {};
  const float* own_m = nullptr;
  const std::uint8_t* reach = nullptr;
  const std::uint32_t* reaches = nullptr;
  /// Where pixels of this ring are.
  AgingWorkspace::Blocks own;
  int ring = 0;
  float moved_m = 0;
  int width = 0;
};
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

/// The least of each number in [begin - kLanes, end + kLanes) and its two neighbours; beside
/// [begin, end) there is nothing.
HWY_INLINE void fill_least_of_neighbours(float* x, int begin, int end, float* out) {
  for (int i = 1; i <= 2; ++i) store(Lanes(kHoldsNothing_m), x + begin - i * kLanes);
  for (int i = 0; i < 2; ++i) store(Lanes(kHoldsNothing_m), x + end + i * kLanes);
  for (int u = begin - kLanes; u < end + kLanes; u += kLanes) {
    store(least(least(load(x + u - 1), load(x + u)), load(x + u + 1)), out + u);
  }
}

/// Takes what the pixels of this ring have left into x, in the blocks that have any.
HWY_INLINE void take_own(const RingRow& row, float* x) {
  const auto wanted = hn::Set(NumberTag(), row.ring);
  for (int block = row.own.begin; block < row.own.end; ++block) {
    if ((row.reaches[block] >> row.ring & 1) == 0) continue;
    for_row(
        block * kBlock_px, std::min((block + 1) * kBlock_px, row.width),
        [&](int u) {
          const auto numbers = hn::PromoteTo(NumberTag(), hn::LoadU(ByteTag(), row.reach + u));
          const LaneMask is_wanted = hn::RebindMask(FloatTag(), hn::Eq(numbers, wanted));
          const Lanes left = greatest(load(row.own_m + u) - Lanes(row.moved_m), Lanes(0.0f));
          store(least(load(x + u), select(is_wanted, left, Lanes(kHoldsNothing_m))), x + u);
        },
        [&](int u) {
          if (row.reach[u] == row.ring) {
            x[u] = std::min(x[u], std::max(0.0f, row.own_m[u] - row.moved_m));
          }
        });
  }
}

/// Writes `part` of a ring's row, of whole vectors, and one more on either side.
void fill_ring(const RingRow& row, AgingWorkspace::Part part, float* x, float* out) {
  const float* const above = row.beyond[0];
  const float* const beside = row.beyond[1];
  const float* const below = row.beyond[2];
  for (int u = part.begin; u < part.end; u += kLanes) {
    Lanes beyond(kHoldsNothing_m);
    if (above) beyond = least(load(above + u), least(load(beside + u), load(below + u)));
    store(beyond, x + u);
  }
  take_own(row, x);
  fill_least_of_neighbours(x, part.begin, part.end, out);
}

}  // namespace HWY_NAMESPACE
}  // namespace berth
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace berth {

HWY_EXPORT(count_borders);
HWY_EXPORT(fill_ring);

namespace {

int blocks_of(int width) { return divide_up(width, kBlock_px); }

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

/// The others: what a pixel of reach r has left goes on from ring r to ring r - 1 by one pixel to
/// all sides, and from ring 0 by one more to the image. All rings go down the image together, each
/// a row behind the next greater one, so that of each only three rows are kept, each pixel with
/// its neighbours in the row. Of a row only that part is touched to which a ring's pixels reach.
class Rings {
 public:
  Rings(const DepthImage& own_m, float moved_m, int greatest, AgingWorkspace& workspace)
      : own_m_(own_m),
        moved_m_(moved_m),
        greatest_(greatest),
        workspace_(workspace),
        width_(own_m.width()),
        height_(own_m.height()),
        stride_(divide_up(width_, kAlign) * kAlign + 2 * kMargin) {
    const auto slots = static_cast<std::size_t>(3 * (greatest + 1));
    workspace.rows.assign((slots + 1) * stride_ + kAlign, kHoldsNothing_m);
    void* begin = workspace.rows.data();
    std::size_t room = workspace.rows.size() * sizeof(float);
    rows_ = static_cast<float*>(std::align(kAlign * sizeof(float), sizeof(float), begin, room));
    workspace.parts.assign(slots, {});
    find_ring_blocks(blocks_of(width_));
  }

  void run(DepthImage& out) {
    for (int step = 0; step <= height_ + greatest_; ++step) {
      for (int ring = greatest_; ring >= 0; --ring) {
        const int v = step - (greatest_ - ring);
        if (v >= 0 && v < height_) fill(ring, v);
      }
      const int v = step - greatest_ - 1;
      if (v >= 0) finish(v, out.row(v));
    }
  }

 private:
  using Part = AgingWorkspace::Part;

  std::size_t slot(int ring, int v) const { return std::size_t(3 * ring + v % 3); }
  float* row_at(std::size_t slot) { return rows_ + slot * stride_ + kMargin; }

  void fill(int ring, int v) {
    Part& kept = workspace_.parts[slot(ring, v)];
    float* const out = row_at(slot(ring, v));
    RingRow row{.own_m = own_m_.row(v),
                .reach = workspace_.reach.row(v),
                .reaches = &workspace_.reaches[static_cast<std::size_t>(blocks_of(width_)) * v],
                .own = workspace_.ring_blocks[std::size_t(greatest_ + 1) * v + ring],
                .ring = ring,
                .moved_m = moved_m_,
                .width = width_};
    Part touched;
    if (ring < greatest_) touched = take_rows(ring + 1, v, row.beyond);
    touched = join(touched, {row.own.begin * kBlock_px, std::min(row.own.end * kBlock_px, width_)});
    const Part before = kept;
    kept = touched.is_empty() ? Part{} : Part{touched.begin - 1, touched.end + 1};
    // Nothing is there outside of it.
    const int middle = kept.is_empty() ? before.end : kept.begin;
    fill_endless(middle - before.begin, out + before.begin);
    if (kept.is_empty()) return;
    fill_endless(before.end - kept.end, out + kept.end);
    HWY_DYNAMIC_DISPATCH(fill_ring)
    (row, {touched.begin & -kAlign, (touched.end + kAlign - 1) & -kAlign},
     row_at(std::size_t(3 * (greatest_ + 1))), out);
  }

  /// E of a row: nothing is free at the image's ends.
  void finish(int v, float* out) {
    if (v == 0 || v + 1 == height_ || width_ < 3) {
      std::fill_n(out, width_, 0.0f);
      return;
    }
    const float* rows[3];
    if (take_rows(0, v, rows).is_empty()) {
      fill_endless(width_, out);
    } else {
      take_least_of(rows, width_, out);
    }
    out[0] = out[width_ - 1] = 0;
  }

  static Part join(const Part& a, const Part& b) {
    if (a.is_empty()) return b;
    if (b.is_empty()) return a;
    return {std::min(a.begin, b.begin), std::max(a.end, b.end)};
  }

  /// A ring's rows around v, and where they hold anything; null where nowhere.
  Part take_rows(int ring, int v, const float* (&rows)[3]) {
    Part part;
    for (int i = 0; i < 3; ++i) {
      const std::size_t at = slot(ring, std::clamp(v - 1 + i, 0, height_ - 1));
      rows[i] = row_at(at);
      part = join(part, workspace_.parts[at]);
    }
    if (part.is_empty()) std::ranges::fill(rows, nullptr);
    return part;
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

  const DepthImage& own_m_;
  float moved_m_;
  int greatest_;
  AgingWorkspace& workspace_;
  int width_;
  int height_;
  std::size_t stride_;
  float* rows_;
};

}  // namespace

void age_free_depth(const Camera& camera, const DepthImage& sensor_depth_m, const DepthImage& own_m,
                    double moved_m, AgingWorkspace& workspace, DepthImage& out) {
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
