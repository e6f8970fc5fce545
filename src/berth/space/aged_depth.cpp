#include "berth/space/aged_depth.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>

#ifndef BERTH_AGED_DEPTH_RINGS
#define BERTH_AGED_DEPTH_RINGS
namespace berth {
/// Pixels with this reach and more are spread by squares.
constexpr int kMostRing = 24;
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
  constexpr float kEndless_m = std::numeric_limits<float>::max();
  const auto wanted = hn::Set(NumberTag(), ring);
  for_row(
      0, width,
      [&](int u) {
        const auto numbers = hn::PromoteTo(NumberTag(), hn::LoadU(ByteTag(), reach + u));
        const LaneMask is_wanted = hn::RebindMask(FloatTag(), hn::Eq(numbers, wanted));
        const Lanes left = greatest(load(own_m + u) - Lanes(moved_m), Lanes(0.0f));
        store(select(is_wanted, left, Lanes(kEndless_m)), out + u);
      },
      [&](int u) { out[u] = reach[u] == ring ? std::max(0.0f, own_m[u] - moved_m) : kEndless_m; });
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

/// x[i] becomes the least of x[i] and from[i].
void take_least(const float* from, int width, float* x) {
  for_row(
      0, width, [&](int u) { store(least(load(x + u), load(from + u)), x + u); },
      [&](int u) { x[u] = std::min(x[u], from[u]); });
}

/// out[i] is the least of the three rows' i-th.
void take_least_of(const float* const (&rows)[3], int width, float* out) {
  for_row(
      0, width,
      [&](int u) {
        store(least(load(rows[0] + u), least(load(rows[1] + u), load(rows[2] + u))), out + u);
      },
      [&](int u) { out[u] = std::min(rows[0][u], std::min(rows[1][u], rows[2][u])); });
}

}  // namespace HWY_NAMESPACE
}  // namespace berth
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace berth {

HWY_EXPORT(count_borders);
HWY_EXPORT(take_ring);
HWY_EXPORT(spread_in_row);
HWY_EXPORT(take_least);
HWY_EXPORT(take_least_of);

namespace {

constexpr float kEndless_m = std::numeric_limits<float>::max();

/// The k of the greatest squares of 2^k pixels that fit into `pixels`, at least one.
int level_of(int pixels) { return std::bit_width(static_cast<unsigned>(pixels)) - 1; }

/// Makes `value` hold in all pixels of `rect`, by squares of the greatest size that fits.
void hold_in(const PixelRect& rect, float value, std::vector<DepthImage>& levels) {
  const int level = level_of(std::min(rect.u_end - rect.u_begin, rect.v_end - rect.v_begin));
  const int side = 1 << level;
  DepthImage& squares = levels[level];
  for (int v = rect.v_begin;; v = std::min(v + side, rect.v_end - side)) {
    for (int u = rect.u_begin;; u = std::min(u + side, rect.u_end - side)) {
      squares(u, v) = std::min(squares(u, v), value);
      if (u + side == rect.u_end) break;
    }
    if (v + side == rect.v_end) break;
  }
}

void take_lesser(const float* from_m, int count, float* to_m) {
  for (int i = 0; i < count; ++i) to_m[i] = from_m[i] < to_m[i] ? from_m[i] : to_m[i];
}

/// The same for many pixels side by side, from the one at (u, v) on: each one's value holds in all
/// that are no more than `reach` from it, which lie in the image.
void hold_around(const float* values, int count, int u, int v, int reach,
                 std::vector<DepthImage>& levels) {
  const int level = level_of(2 * reach + 1);
  const int last = reach + 1 - (1 << level);
  for (const int y : {v - reach, v + last}) {
    for (const int x : {u - reach, u + last}) take_lesser(values, count, levels[level].row(y) + x);
  }
}

/// Takes a row's pixels into the squares: those with one reach at once, but at the image's ends.
void hold_row(const std::vector<float>& left_m, const std::vector<int>& far_reach, int v,
              std::vector<DepthImage>& levels) {
  const int width = levels[0].width();
  const int height = levels[0].height();
  for (int u = 0; u < width;) {
    const int reach = far_reach[u];
    int end = u + 1;
    while (end < width && far_reach[end] == reach) ++end;
    const bool fits = v >= reach && v + reach < height && 2 * reach < width;
    const int inner = fits ? std::clamp(reach, u, end) : end;
    const int outer = fits ? std::clamp(width - reach, inner, end) : end;
    if (reach > 0 && outer > inner) {
      hold_around(&left_m[inner], outer - inner, inner, v, reach, levels);
    }
    for (int at = u; reach > 0 && at < end; ++at) {
      if (at == inner) at = outer;
      if (at == end) break;
      hold_in(clip({at - reach, v - reach, at + reach + 1, v + reach + 1}, width, height),
              left_m[at], levels);
    }
    u = end;
  }
}

/// Each square's value holds in its four quarters.
void hold_in_quarters(const DepthImage& squares, int half, DepthImage& quarters) {
  const int columns = squares.width() - 2 * half + 1;
  for (int v = 0; v + 2 * half <= squares.height(); ++v) {
    for (const int y : {v, v + half}) {
      for (const int x : {0, half}) take_lesser(squares.row(v), columns, quarters.row(y) + x);
    }
  }
}

/// How many pixels beside it a pixel with this reading holds.
class Reach {
 public:
  Reach(const Camera& camera, double moved_m)
      : spread_(std::max(camera.fx_px, camera.fy_px) * moved_m) {
    // Above r where S < spread / r: for a float the next one from there up says the same.
    borders_m_[0] = spread_ > 0 ? std::numeric_limits<float>::infinity() : 0.0f;
    for (int r = 1; r <= kMostRing; ++r) {
      const double border_m = spread_ / r;
      const auto rounded_m = static_cast<float>(border_m);
      borders_m_[r] = rounded_m >= border_m ? rounded_m : std::nextafter(rounded_m, kEndless_m);
    }
  }
  /// At most `most`.
  int of(float sensed_m, int most) const {
    return static_cast<int>(std::min(std::ceil(spread_ / sensed_m), static_cast<double>(most)));
  }
  const float* borders_m() const { return borders_m_.data(); }

 private:
  double spread_;
  std::array<float, kMostRing + 1> borders_m_;
};

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

/// The pixels that reach beyond the rings, by squares: levels[0] has what they leave of each pixel.
void hold_far_reaching(const Reach& reach, const DepthImage& sensor_depth_m,
                       const DepthImage& own_m, float moved_m, AgingWorkspace& workspace) {
  const int width = own_m.width();
  const int height = own_m.height();
  const int most = width + height;
  std::vector<DepthImage>& levels = workspace.levels;
  workspace.left_m.resize(width);
  workspace.far_reach.resize(width);
  float nearest_m = kEndless_m;
  for (const float sensed_m : sensor_depth_m.pixels()) {
    nearest_m = sensed_m < nearest_m ? sensed_m : nearest_m;
  }
  const int widest = std::min({2 * reach.of(nearest_m, most) + 1, width, height});
  const auto level_count = static_cast<std::size_t>(level_of(widest)) + 1;
  levels.resize(std::max(levels.size(), level_count));
  for (std::size_t k = 0; k < level_count; ++k) levels[k].resize(width, height, kEndless_m);
  for (int v = 0; v < height; ++v) {
    for (int u = 0; u < width; ++u) {
      const bool is_far = workspace.reach(u, v) > kMostRing;
      workspace.far_reach[u] = is_far ? reach.of(sensor_depth_m(u, v), most) : 0;
      workspace.left_m[u] = std::max(0.0f, own_m(u, v) - moved_m);
    }
    hold_row(workspace.left_m, workspace.far_reach, v, levels);
  }
  for (std::size_t k = level_count - 1; k > 0; --k) {
    hold_in_quarters(levels[k], 1 << (k - 1), levels[k - 1]);
  }
}

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
        height_(own_m.height()),
        blocks_(blocks_of(width_)) {
    workspace.rows.assign(std::size_t(3 * (greatest + 1) + 1) * width_ + 2 * kMargin, kEndless_m);
    workspace.parts.assign(std::size_t(3 * (greatest + 1)), {});
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
    // Nothing is there outside of the new part. The image's row had other content before.
    if (ring == 0) kept = {0, width_};
    std::fill(out + kept.begin, out + kept.end, kEndless_m);
    kept = ring < greatest_ ? take_rings_beyond(ring + 1, v, out) : Part{};
    const Part pixels = pixels_of(ring, v);
    if (pixels.is_empty()) return;
    const float* const spread = spread_own(ring, v, pixels);
    const Part reached{std::max(pixels.begin - ring, 0), std::min(pixels.end + ring, width_)};
    HWY_DYNAMIC_DISPATCH(take_least)
    (spread + reached.begin, reached.end - reached.begin, out + reached.begin);
    kept = join(kept, reached);
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
    HWY_DYNAMIC_DISPATCH(take_least_of)(rows, part.end - part.begin, out + part.begin);
    return part;
  }

  /// Where in the row pixels of this ring are.
  Part pixels_of(int ring, int v) const {
    const std::uint32_t* const reaches = &workspace_.reaches[std::size_t(blocks_) * v];
    Part part;
    for (int i = 0; i < blocks_; ++i) {
      if ((reaches[i] >> ring & 1) == 0) continue;
      part = join(part, {i * kBlock_px, std::min((i + 1) * kBlock_px, width_)});
    }
    return part;
  }

  /// What these pixels hold of the row; of others nothing is said.
  const float* spread_own(int ring, int v, const Part& pixels) {
    float* const x = scratch() + pixels.begin;
    const int count = pixels.end - pixels.begin;
    HWY_DYNAMIC_DISPATCH(take_ring)
    (own_m_.row(v) + pixels.begin, workspace_.reach.row(v) + pixels.begin, ring, moved_m_, count,
     x);
    if (ring > 0) {
      std::fill_n(x - kMargin, kMargin, kEndless_m);
      std::fill_n(x + count, kMargin, kEndless_m);
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
  int blocks_;
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
  Rings(own_m, moved, level_of(static_cast<int>(in_rings | 1)), workspace).run(out);
  if ((reaches & kFarBit) == 0) return;
  hold_far_reaching(reach, sensor_depth_m, own_m, moved, workspace);
  for (int v = 0; v < height; ++v) {
    HWY_DYNAMIC_DISPATCH(take_least)(workspace.levels[0].row(v), width, out.row(v));
  }
}

}  // namespace berth
#endif  // HWY_ONCE
