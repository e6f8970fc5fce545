#include "berth/space/aged_depth.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <memory>

#include "berth/vector/divide_up.hpp"

#ifndef BERTH_AGED_RINGS
#define BERTH_AGED_RINGS
namespace berth {
/// What lies beside a row on either side: four vectors, and as much as the greatest ring reaches.
constexpr int kMargin = 160;
/// Rows begin at a multiple of this number, the longest vector's.
constexpr int kAlign = 32;
/// The pixels of a row for which the rings that occur are known at once.
constexpr int kBlock_px = 64;

/// What a ring's row is made of.
struct RingRow {
  /// The next greater ring's rows above, beside and below, from column 0 on; null where it has
  /// nothing there.
  const DepthUnits* beyond[3] = {};
  const DepthUnits* sensed = nullptr;
  const DepthUnits* own = nullptr;
  const std::uint32_t* rings = nullptr;
  /// Where pixels of this ring are, and the readings that are of it.
  AgingWorkspace::Blocks blocks;
  int ring = 0;
  DepthUnits first = 0;
  DepthUnits last = 0;
  DepthUnits moved = 0;
  int width = 0;
};
}  // namespace berth
#endif

// Compiles the rest of this file once for each instruction set.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "berth/space/aged_rings.cpp"
#include "hwy/foreach_target.h"

#include "berth/space/rows-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace berth {
namespace HWY_NAMESPACE {

/// The ring of a reading; `ring` is where to look first.
HWY_INLINE int ring_of(DepthUnits sensed, const RingBorders& borders, int ring) {
  while (ring <= kMostRing && sensed < borders[ring]) ++ring;
  while (ring > 0 && sensed >= borders[ring - 1]) --ring;
  return ring;
}

/// A bit for each ring from the least to the greatest that occurs in each kBlock_px of a row;
/// `of_none` for pixels without a reading.
void find_rings_of_row(const DepthUnits* sensed, const RingBorders& borders, std::uint32_t of_none,
                       int width, std::uint32_t* found) {
  int near = 0, far = 0;
  for (int begin = 0; begin < width; begin += kBlock_px) {
    const int end = std::min(begin + kBlock_px, width);
    // One more than a reading is 0 where there is none. Such loops are the compiler's to make
    // vectors of.
    DepthUnits least = kEndlessUnits, least_next = kEndlessUnits, greatest_next = 0;
    for (int u = begin; u < end; ++u) {
      const auto next = static_cast<DepthUnits>(sensed[u] + 1);
      least = std::min(least, sensed[u]);
      least_next = std::min(least_next, next);
      greatest_next = std::max(greatest_next, next);
    }
    std::uint32_t rings = least_next == 0 ? of_none : 0;
    if (greatest_next > 0) {
      near = ring_of(least, borders, near);
      far = ring_of(static_cast<DepthUnits>(greatest_next - 1), borders, far);
      rings |= (2u << near) - (1u << far);
    }
    *found++ = rings;
  }
}

/// left_of() of a vector.
HWY_INLINE Shorts shorts_left_of(Shorts own, DepthUnits moved) {
  const ShortTag d;
  const auto left = hn::SaturatedSub(own, hn::Set(d, moved));
  return hn::IfThenElse(hn::Eq(own, hn::Set(d, kEndlessUnits)), own, left);
}

/// The least of each number in [begin - kShorts, end + kShorts) and its two neighbours; beside
/// [begin, end) there is nothing.
HWY_INLINE void fill_least_of_neighbours(DepthUnits* x, int begin, int end, DepthUnits* out) {
  const auto nothing = hn::Set(ShortTag(), kEndlessUnits);
  for (int i = 1; i <= 2; ++i) store_shorts(nothing, x + begin - i * kShorts);
  for (int i = 0; i < 2; ++i) store_shorts(nothing, x + end + i * kShorts);
  for (int u = begin - kShorts; u < end + kShorts; u += kShorts) {
    const auto beside = hn::Min(load_shorts(x + u - 1), load_shorts(x + u + 1));
    store_shorts(hn::Min(beside, load_shorts(x + u)), out + u);
  }
}

/// Takes what the pixels of this ring have left into x, in the blocks that have any.
HWY_INLINE void take_own(const RingRow& row, DepthUnits* x) {
  const ShortTag d;
  const auto first = hn::Set(d, row.first);
  const auto last = hn::Set(d, row.last);
  const auto nothing = hn::Set(d, kEndlessUnits);
  for (int block = row.blocks.begin; block < row.blocks.end; ++block) {
    if ((row.rings[block] >> row.ring & 1) == 0) continue;
    for_row<kShorts>(
        block * kBlock_px, std::min((block + 1) * kBlock_px, row.width),
        [&](int u) {
          const auto sensed = load_shorts(row.sensed + u);
          const auto is_wanted = hn::Eq(hn::Min(hn::Max(sensed, first), last), sensed);
          const auto left = shorts_left_of(load_shorts(row.own + u), row.moved);
          store_shorts(hn::Min(load_shorts(x + u), hn::IfThenElse(is_wanted, left, nothing)),
                       x + u);
        },
        [&](int u) {
          if (row.sensed[u] < row.first || row.sensed[u] > row.last) return;
          x[u] = std::min(x[u], left_of(row.own[u], row.moved));
        });
  }
}

/// Writes `part` of a ring's row, of whole vectors, and one more on either side.
void fill_ring(const RingRow& row, AgingWorkspace::Part part, DepthUnits* x, DepthUnits* out) {
  for (int u = part.begin; u < part.end; u += kShorts) {
    auto beyond = hn::Set(ShortTag(), kEndlessUnits);
    if (row.beyond[0]) {
      beyond = hn::Min(hn::Min(load_shorts(row.beyond[0] + u), load_shorts(row.beyond[1] + u)),
                       load_shorts(row.beyond[2] + u));
    }
    store_shorts(beyond, x + u);
  }
  take_own(row, x);
  fill_least_of_neighbours(x, part.begin, part.end, out);
}

/// out[i] is the least of the three rows' i-th.
void fill_least_of_rows(const DepthUnits* const (&rows)[3], int width, DepthUnits* out) {
  for_row<kShorts>(
      0, width,
      [&](int u) {
        const auto beside = hn::Min(load_shorts(rows[0] + u), load_shorts(rows[2] + u));
        store_shorts(hn::Min(beside, load_shorts(rows[1] + u)), out + u);
      },
      [&](int u) {
        out[u] = std::min({rows[0][u], rows[1][u], rows[2][u]});
      });
}

/// Takes each number into two neighbours.
void take_twice(const DepthUnits* from, int width, DepthUnits* HWY_RESTRICT out) {
  for (int i = 0; i < width / 2; ++i) {
    out[2 * i] = std::min(out[2 * i], from[i]);
    out[2 * i + 1] = std::min(out[2 * i + 1], from[i]);
  }
  if (width % 2 != 0) out[width - 1] = std::min(out[width - 1], from[width / 2]);
}

}  // namespace HWY_NAMESPACE
}  // namespace berth
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace berth {

HWY_EXPORT(find_rings_of_row);
HWY_EXPORT(fill_ring);
HWY_EXPORT(fill_least_of_rows);
HWY_EXPORT(take_twice);

namespace {

constexpr std::uint32_t kFarBit = 1u << (kMostRing + 1);

bool is_far(std::uint32_t rings) { return (rings & kFarBit) != 0; }

int blocks_of(int width) { return divide_up(width, kBlock_px); }

void fill_endless(int count, DepthUnits* x) {
  if (count > 0) std::fill_n(x, count, kEndlessUnits);
}

/// What a pixel of ring r has left goes on from ring r to ring r - 1 by one pixel to all sides, and
/// from ring 0 by one more to the image. All rings go down the image together, each a row behind
/// the next greater one, so that of each only three rows are kept, each pixel with its neighbours
/// in the row. Of a row only that part is touched to which a ring's pixels reach.
class Rings {
 public:
  Rings(const LevelImages& images, AgingWorkspace::Level& level, AgingWorkspace& workspace)
      : images_(images),
        level_(level),
        workspace_(workspace),
        width_(images.own.width()),
        height_(images.own.height()),
        stride_(divide_up(width_, kAlign) * kAlign + 2 * kMargin) {
    std::uint32_t found = 1;
    for (const std::uint32_t some : level.rings) found |= some & (kFarBit - 1);
    greatest_ = std::bit_width(found) - 1;
    const auto slots = static_cast<std::size_t>(3 * (greatest_ + 1));
    workspace.rows.assign((slots + 1) * stride_ + kAlign, kEndlessUnits);
    void* begin = workspace.rows.data();
    std::size_t room = workspace.rows.size() * sizeof(DepthUnits);
    rows_ = static_cast<DepthUnits*>(
        std::align(kAlign * sizeof(DepthUnits), sizeof(DepthUnits), begin, room));
    workspace.parts.assign(slots, {});
    find_ring_blocks(blocks_of(width_));
  }

  /// The rows of `out` follow each other.
  void run(DepthUnits* out) {
    for (int step = 0; step <= height_ + greatest_; ++step) {
      for (int ring = greatest_; ring >= 0; --ring) {
        const int v = step - (greatest_ - ring);
        if (v >= 0 && v < height_) fill(ring, v);
      }
      const int v = step - greatest_ - 1;
      if (v >= 0) finish(v, out + static_cast<std::ptrdiff_t>(v) * width_);
    }
  }

 private:
  using Part = AgingWorkspace::Part;

  std::size_t slot(int ring, int v) const { return std::size_t(3 * ring + v % 3); }
  DepthUnits* row_at(std::size_t slot) { return rows_ + slot * stride_ + kMargin; }

  void fill(int ring, int v) {
    Part& kept = workspace_.parts[slot(ring, v)];
    DepthUnits* const out = row_at(slot(ring, v));
    RingRow row{
        .sensed = images_.sensor_depth.row(v),
        .own = images_.own.row(v),
        .rings = &level_.rings[static_cast<std::size_t>(blocks_of(width_)) * v],
        .blocks = level_.ring_blocks[std::size_t(greatest_ + 1) * v + ring],
        .ring = ring,
        .first = images_.borders[ring],
        .last = ring == 0 ? kEndlessUnits : static_cast<DepthUnits>(images_.borders[ring - 1] - 1),
        .moved = images_.moved,
        .width = width_};
    Part touched;
    if (ring < greatest_) touched = take_rows(ring + 1, v, row.beyond);
    touched =
        join(touched, {row.blocks.begin * kBlock_px, std::min(row.blocks.end * kBlock_px, width_)});
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

  /// Writes the final row; border pixels free nothing.
  void finish(int v, DepthUnits* out) {
    if (images_.is_image && (v == 0 || v + 1 == height_ || width_ < 3)) {
      std::fill_n(out, width_, DepthUnits{0});
      return;
    }
    const DepthUnits* rows[3];
    if (take_rows(0, v, rows).is_empty()) {
      fill_endless(width_, out);
    } else {
      HWY_DYNAMIC_DISPATCH(fill_least_of_rows)(rows, width_, out);
    }
    if (images_.beyond) HWY_DYNAMIC_DISPATCH(take_twice)(images_.beyond->row(v / 2), width_, out);
    if (images_.is_image) out[0] = out[width_ - 1] = 0;
  }

  static Part join(const Part& a, const Part& b) {
    if (a.is_empty()) return b;
    if (b.is_empty()) return a;
    return {std::min(a.begin, b.begin), std::max(a.end, b.end)};
  }

  /// A ring's rows around v, and where they hold anything; null where nowhere.
  Part take_rows(int ring, int v, const DepthUnits* (&rows)[3]) {
    Part part;
    for (int i = 0; i < 3; ++i) {
      const std::size_t at = slot(ring, std::clamp(v - 1 + i, 0, height_ - 1));
      rows[i] = row_at(at);
      part = join(part, workspace_.parts[at]);
    }
    if (part.is_empty()) std::ranges::fill(rows, nullptr);
    return part;
  }

  /// Writes ring_blocks.
  void find_ring_blocks(int blocks) {
    level_.ring_blocks.assign(std::size_t(greatest_ + 1) * height_, {});
    for (int v = 0; v < height_; ++v) {
      AgingWorkspace::Blocks* const of_row = &level_.ring_blocks[std::size_t(greatest_ + 1) * v];
      for (int i = 0; i < blocks; ++i) {
        std::uint32_t found = level_.rings[std::size_t(blocks) * v + i] & (kFarBit - 1);
        for (; found != 0; found &= found - 1) {
          AgingWorkspace::Blocks& of_ring = of_row[std::countr_zero(found)];
          if (of_ring.end == 0) of_ring.begin = static_cast<std::int16_t>(i);
          of_ring.end = static_cast<std::int16_t>(i + 1);
        }
      }
    }
  }

  const LevelImages& images_;
  AgingWorkspace::Level& level_;
  AgingWorkspace& workspace_;
  int width_;
  int height_;
  int greatest_ = 0;
  std::size_t stride_;
  DepthUnits* rows_;
};

}  // namespace

RingBorders ring_borders(double spread_m, int side_px) {
  RingBorders borders;
  for (int q = 1; q <= kMostRing + 1; ++q) {
    const double reach_px = static_cast<double>(side_px) * q - 1;
    const double border = std::ceil(kUnitsPerMetre * spread_m / reach_px);
    borders[q - 1] =
        spread_m > 0 ? static_cast<DepthUnits>(std::min(border, 1.0 * kEndlessUnits)) : 0;
  }
  return borders;
}

bool find_rings(const LevelImages& images, std::vector<std::uint32_t>& rings) {
  const int width = images.own.width();
  const auto blocks = static_cast<std::size_t>(blocks_of(width));
  rings.resize(blocks * images.own.height());
  for (int v = 0; v < images.own.height(); ++v) {
    HWY_DYNAMIC_DISPATCH(find_rings_of_row)
    (images.sensor_depth.row(v), images.borders, images.is_image ? 1 : 0, width,
     &rings[blocks * v]);
  }
  return std::ranges::any_of(rings, is_far);
}

bool reaches_far(const LevelImages& images, const std::vector<std::uint32_t>& rings, int v) {
  const int blocks = blocks_of(images.own.width());
  const std::uint32_t* const of_row = &rings[std::size_t(blocks) * v];
  return std::any_of(of_row, of_row + blocks, is_far);
}

void hold_rings(const LevelImages& images, AgingWorkspace::Level& level, AgingWorkspace& workspace,
                DepthUnits* out) {
  Rings(images, level, workspace).run(out);
}

}  // namespace berth
#endif  // HWY_ONCE
