#include "berth/space/closed_free_depth.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#ifndef BERTH_CLOSED_FREE_DEPTH
#define BERTH_CLOSED_FREE_DEPTH
namespace berth {

/// Zeros beside a row of the image: as far as a tier looks, and a vector.
constexpr int kClosingMargin_px = 64;
/// As far as the tiers look beyond a pixel or block.
constexpr int kClosingReach = 6;
/// A depth in mm that stands for all that are greater.
constexpr int kMostDepth_mm = 65535;

/// The blocks in a disc around one, row by row: reach(dy) is how far they go to both sides.
struct DiscRows {
  static constexpr int kMostRows = 4;
  int last_row = 0;
  std::array<int, kMostRows + 1> reaches{};
  int reach(int dy) const { return reaches[dy < 0 ? -dy : dy]; }
};

/// Row buffers that are used in turn, for each length of run.
struct RunRing {
  static constexpr int kRows = 16;
  std::uint16_t* first = nullptr;
  int stride = 0;
  /// Row y of the runs that reach so far to both sides.
  std::uint16_t* row(int reach_px, int y) const {
    return first + static_cast<std::ptrdiff_t>(reach_px * kRows + (y & (kRows - 1))) * stride;
  }
};
}  // namespace berth
#endif

// Compiles the rest of this file once for each instruction set.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "berth/space/closed_free_depth.cpp"
#include "hwy/foreach_target.h"

#include "berth/space/rows-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace berth {
namespace HWY_NAMESPACE {

using ShortTag = hn::CappedTag<std::uint16_t, 32>;
using Shorts = hn::Vec<ShortTag>;
constexpr int kShorts = static_cast<int>(hn::MaxLanes(ShortTag()));

HWY_INLINE Shorts load_shorts(const std::uint16_t* x) { return hn::LoadU(ShortTag(), x); }

struct TakeGreatest {
  HWY_INLINE Shorts operator()(Shorts a, Shorts b) const { return hn::Max(a, b); }
};
struct TakeLeast {
  HWY_INLINE Shorts operator()(Shorts a, Shorts b) const { return hn::Min(a, b); }
};

/// The runs of row y that reach 1 to `most` to both sides, from the row itself, which is its run of
/// reach 0 and has the columns [begin, end).
template <class Take>
HWY_INLINE void fill_runs(const RunRing& ring, int y, int most, int begin, int end, Take take) {
  for (int reach = 1; reach <= most; ++reach) {
    const std::uint16_t* const from = ring.row(reach - 1, y);
    std::uint16_t* const to = ring.row(reach, y);
    for (int x = begin + reach; x < end - reach; x += kShorts) {
      auto of_run = take(load_shorts(from + x - 1), load_shorts(from + x + 1));
      if (reach == 1) of_run = take(of_run, load_shorts(from + x));
      hn::StoreU(of_run, ShortTag(), to + x);
    }
  }
}

void fill_greatest_runs(const RunRing& ring, int y, int most, int begin, int end) {
  fill_runs(ring, y, most, begin, end, TakeGreatest());
}
void fill_least_runs(const RunRing& ring, int y, int most, int begin, int end) {
  fill_runs(ring, y, most, begin, end, TakeLeast());
}

/// What a disc around each pixel of row y has, put together from the runs of its rows.
template <class Take>
HWY_INLINE void fill_discs(const RunRing& ring, const DiscRows& disc, int y, int begin, int end,
                           std::uint16_t* out, Take take) {
  for (int x = begin; x < end; x += kShorts) {
    auto all = load_shorts(ring.row(disc.reach(0), y) + x);
    for (int dy = 1; dy <= disc.last_row; ++dy) {
      const int reach = disc.reach(dy);
      all = take(all, take(load_shorts(ring.row(reach, y - dy) + x),
                           load_shorts(ring.row(reach, y + dy) + x)));
    }
    hn::StoreU(all, ShortTag(), out + x);
  }
}

void fill_greatest_of_discs(const RunRing& ring, const DiscRows& disc, int y, int begin, int end,
                            std::uint16_t* out) {
  fill_discs(ring, disc, y, begin, end, out, TakeGreatest());
}
void fill_least_of_discs(const RunRing& ring, const DiscRows& disc, int y, int begin, int end,
                         std::uint16_t* out) {
  fill_discs(ring, disc, y, begin, end, out, TakeLeast());
}

/// The least that two neighbours, one of them the pixel itself, both have at most.
void fill_pairs(const std::uint16_t* above, const std::uint16_t* middle, const std::uint16_t* below,
                int width, std::uint16_t* out) {
  for (int x = 0; x < width; x += kShorts) {
    const auto of_neighbours =
        hn::Min(hn::Min(load_shorts(above + x), load_shorts(below + x)),
                hn::Min(load_shorts(middle + x - 1), load_shorts(middle + x + 1)));
    hn::StoreU(hn::Max(load_shorts(middle + x), of_neighbours), ShortTag(), out + x);
  }
}

/// Where `out` is below `top_mm` it stays; elsewhere it becomes what the next tier says, but at
/// least that.
void go_on_from(const std::uint16_t* next, std::uint16_t top_mm, int width, std::uint16_t* out) {
  const ShortTag d;
  const auto top = hn::Set(d, top_mm);
  for (int x = 0; x < width; x += kShorts) {
    const auto was = load_shorts(out + x);
    const auto is_settled = hn::Lt(was, top);
    hn::StoreU(hn::IfThenElse(is_settled, was, hn::Max(top, load_shorts(next + x))), d, out + x);
  }
}

/// Whether some number is at least this; what stands beyond the row's end counts, and is 0.
bool has_at_least(const std::uint16_t* row, std::uint16_t least, int width) {
  const ShortTag d;
  auto most = hn::Zero(d);
  for (int x = 0; x < width; x += kShorts) most = hn::Max(most, load_shorts(row + x));
  return !hn::AllTrue(d, hn::Lt(most, hn::Set(d, least)));
}

/// The greatest of each 2 x 2 pixels of two rows. Such loops are the compiler's to make vectors of.
void fill_blocks(const std::uint16_t* above, const std::uint16_t* below, int count,
                 std::uint16_t* HWY_RESTRICT out) {
  for (int i = 0; i < count; ++i) {
    const std::uint16_t first = std::max(above[2 * i], below[2 * i]);
    const std::uint16_t second = std::max(above[2 * i + 1], below[2 * i + 1]);
    out[i] = std::max(first, second);
  }
}

/// Each number twice.
void fill_twice(const std::uint16_t* from, int count, std::uint16_t* HWY_RESTRICT out) {
  for (int i = 0; i < count; ++i) out[2 * i] = out[2 * i + 1] = from[i];
}

/// Whole mm, rounded down.
void fill_mm(const float* depth_m, int width, std::uint16_t* out) {
  using WholeTag = hn::Rebind<std::int32_t, FloatTag>;
  using HalfTag = hn::Rebind<std::uint16_t, FloatTag>;
  for_row(
      0, width,
      [&](int u) {
        const Lanes mm = least(load(depth_m + u) * Lanes(1000.0f), Lanes(float(kMostDepth_mm)));
        hn::StoreU(hn::DemoteTo(HalfTag(), hn::ConvertTo(WholeTag(), mm.v)), HalfTag(), out + u);
      },
      [&](int u) {
        out[u] = static_cast<std::uint16_t>(std::min(depth_m[u] * 1000.0f, float(kMostDepth_mm)));
      });
}

/// Raises depths to so many mm, at most `most_mm`, less `less_m`.
void raise(const std::uint16_t* depth_mm, std::uint16_t most_mm, float less_m, int width,
           float* depth_m) {
  using WholeTag = hn::Rebind<std::int32_t, FloatTag>;
  using HalfTag = hn::Rebind<std::uint16_t, FloatTag>;
  for_row(
      0, width,
      [&](int u) {
        const auto mm = hn::PromoteTo(WholeTag(), hn::LoadU(HalfTag(), depth_mm + u));
        const Lanes capped = least(Lanes(hn::ConvertTo(FloatTag(), mm)), Lanes(float(most_mm)));
        const Lanes m = capped * Lanes(0.001f) - Lanes(less_m);
        store(greatest(m, load(depth_m + u)), depth_m + u);
      },
      [&](int u) {
        const auto mm = static_cast<float>(std::min(depth_mm[u], most_mm));
        depth_m[u] = std::max(mm * 0.001f - less_m, depth_m[u]);
      });
}

}  // namespace HWY_NAMESPACE
}  // namespace berth
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace berth {

HWY_EXPORT(fill_greatest_runs);
HWY_EXPORT(fill_least_runs);
HWY_EXPORT(fill_greatest_of_discs);
HWY_EXPORT(fill_least_of_discs);
HWY_EXPORT(fill_pairs);
HWY_EXPORT(fill_blocks);
HWY_EXPORT(fill_twice);
HWY_EXPORT(go_on_from);
HWY_EXPORT(has_at_least);
HWY_EXPORT(fill_mm);
HWY_EXPORT(raise);

namespace {

/// From a block's middle to the nearest and the farthest pixel of the one that is so many blocks
/// away, along an axis.
double nearest_px(int side_px, int blocks) {
  return blocks == 0 ? (side_px - 1) / 2.0 : side_px * blocks - (side_px - 1) / 2.0;
}
double farthest_px(int side_px, int blocks) { return side_px * blocks + (side_px - 1) / 2.0; }

/// All blocks within so many of one.
DiscRows looked_at_by(const ClosingTier& tier) {
  DiscRows disc;
  disc.last_row = tier.radius_blocks;
  for (int dy = 0; dy <= disc.last_row; ++dy) {
    disc.reaches[dy] =
        static_cast<int>(std::sqrt(tier.radius_blocks * tier.radius_blocks - dy * dy));
  }
  return disc;
}

/// All blocks with a pixel within the tier's reach of the middle of one.
DiscRows reached_by(const ClosingTier& tier) {
  DiscRows disc;
  const double reach_px = tier.reach_px();
  for (int dy = 0; nearest_px(tier.side_px, dy) <= reach_px; ++dy) {
    const double y_px = nearest_px(tier.side_px, dy);
    const double x_px = std::sqrt(reach_px * reach_px - y_px * y_px);
    disc.last_row = dy;
    while (nearest_px(tier.side_px, disc.reaches[dy] + 1) <= x_px) ++disc.reaches[dy];
  }
  return disc;
}

/// One image's way through the tiers.
class Closing {
 public:
  Closing(const Camera& camera, double detection_capability_m, ClosingWorkspace& workspace,
          DepthImage& own_m)
      : width_(own_m.width()),
        height_(own_m.height()),
        stride_(width_ + 2 * kClosingMargin_px),
        ball_px_m_(std::min(camera.fx_px, camera.fy_px) * detection_capability_m / 2),
        half_m_(static_cast<float>(detection_capability_m / 2)),
        workspace_(workspace),
        own_m_(own_m),
        rows_end_(height_) {
    if (workspace.width == width_ && workspace.height == height_) return;
    workspace.width = width_;
    workspace.height = height_;
    workspace.rows.assign(std::size_t(first_scratch() + 2) * stride_, 0);
    workspace.rings.assign(std::size_t(2) * RunRing::kRows * (kClosingReach + 1) * stride_, 0);
  }

  void run() {
    for (int v = 0; v < height_; ++v) {
      HWY_DYNAMIC_DISPATCH(fill_mm)(own_m_.row(v), width_, own_mm(1, v));
    }
    for (int v = 0; v < (height_ + 1) / 2; ++v) {
      HWY_DYNAMIC_DISPATCH(fill_blocks)
      (own_mm(1, 2 * v), own_mm(1, 2 * v + 1), (width_ + 1) / 2, own_mm(2, v));
    }
    for (const ClosingTier& tier : kClosingTiers) {
      if (rows_begin_ >= rows_end_) break;
      close(tier);
      go_on_above(top_mm(tier.least_radius_px()));
    }
    for (int v = rows_begin_; v < rows_end_; ++v) {
      HWY_DYNAMIC_DISPATCH(fill_pairs)
      (own_mm(1, v - 1), own_mm(1, v), own_mm(1, v + 1), width_, scratch(0));
      take(scratch(0), v);
    }
    const std::uint16_t most_mm = top_mm(1);
    for (int v = 0; v < height_; ++v) {
      HWY_DYNAMIC_DISPATCH(raise)(closed_mm(v), most_mm, half_m_, width_, own_m_.row(v));
    }
  }

 private:
  /// The depth in mm at which the ball covers discs of this radius.
  std::uint16_t top_mm(double radius_px) const {
    return static_cast<std::uint16_t>(std::min(1000 * ball_px_m_ / radius_px, 1.0 * kMostDepth_mm));
  }
  int first_coarse() const { return height_ + 2 * kClosingReach; }
  int first_closed() const { return first_coarse() + (height_ + 1) / 2 + 2 * kClosingReach; }
  int first_scratch() const { return first_closed() + height_; }
  std::uint16_t* at(int row) {
    return workspace_.rows.data() + static_cast<std::ptrdiff_t>(row) * stride_ + kClosingMargin_px;
  }
  /// A row of the image's blocks with this side.
  std::uint16_t* own_mm(int side_px, int v) {
    return at(kClosingReach + v + (side_px == 1 ? 0 : first_coarse()));
  }
  std::uint16_t* closed_mm(int v) { return at(first_closed() + v); }
  std::uint16_t* scratch(int number) { return at(first_scratch() + number); }
  RunRing ring(int number) {
    const std::ptrdiff_t size = std::ptrdiff_t(RunRing::kRows) * (kClosingReach + 1) * stride_;
    return {workspace_.rings.data() + number * size + kClosingMargin_px, stride_};
  }

  /// Goes down the blocks: runs, what discs of blocks all free at most, its runs, discs of those.
  void close(const ClosingTier& tier) {
    const int side_px = tier.side_px;
    const int width = (width_ + side_px - 1) / side_px;
    const int begin = rows_begin_ / side_px;
    const int end = (rows_end_ + side_px - 1) / side_px;
    const DiscRows looked_at = looked_at_by(tier);
    const DiscRows reached = reached_by(tier);
    const int ahead = looked_at.last_row;
    const int beside = reached.last_row;
    const int aside = reached.reach(0);
    const RunRing greatest = ring(0);
    const RunRing least = ring(1);
    for (int v = begin - beside - ahead; v < end + beside + ahead; ++v) {
      std::copy_n(own_mm(side_px, v) - kClosingReach, width + 2 * kClosingReach,
                  greatest.row(0, v) - kClosingReach);
      HWY_DYNAMIC_DISPATCH(fill_greatest_runs)
      (greatest, v, looked_at.reach(0), -aside - ahead, width + aside + ahead);
      const int middle = v - ahead;
      if (middle < begin - beside) continue;
      HWY_DYNAMIC_DISPATCH(fill_greatest_of_discs)
      (greatest, looked_at, middle, -aside, width + aside, least.row(0, middle));
      HWY_DYNAMIC_DISPATCH(fill_least_runs)(least, middle, aside, -aside, width + aside);
      const int done = middle - beside;
      if (done < begin) continue;
      HWY_DYNAMIC_DISPATCH(fill_least_of_discs)(least, reached, done, 0, width, scratch(0));
      take_blocks(side_px, done, width);
    }
  }

  /// The row of blocks in the scratch is what a tier says.
  void take_blocks(int side_px, int row, int width) {
    if (side_px == 1) return take(scratch(0), row);
    HWY_DYNAMIC_DISPATCH(fill_twice)(scratch(0), width, scratch(1));
    for (int v = std::max(2 * row, rows_begin_); v < std::min(2 * row + 2, rows_end_); ++v) {
      take(scratch(1), v);
    }
  }

  void take(const std::uint16_t* next_mm, int v) {
    HWY_DYNAMIC_DISPATCH(go_on_from)(next_mm, before_mm_, width_, closed_mm(v));
    std::fill_n(closed_mm(v) + width_, kClosingMargin_px, std::uint16_t{0});
  }

  /// The next tier has something to say from this depth on, and in some rows nothing.
  void go_on_above(std::uint16_t top_mm) {
    before_mm_ = top_mm;
    const auto has_more = [&](int v) {
      return HWY_DYNAMIC_DISPATCH(has_at_least)(closed_mm(v), top_mm, width_);
    };
    while (rows_begin_ < rows_end_ && !has_more(rows_begin_)) ++rows_begin_;
    while (rows_begin_ < rows_end_ && !has_more(rows_end_ - 1)) --rows_end_;
  }

  int width_;
  int height_;
  int stride_;
  /// The ball's radius in the image at 1 m.
  double ball_px_m_;
  float half_m_;
  ClosingWorkspace& workspace_;
  DepthImage& own_m_;
  int rows_begin_ = 0;
  int rows_end_;
  /// What the tiers before have an answer up to.
  std::uint16_t before_mm_ = 0;
};

}  // namespace

double ClosingTier::least_radius_px() const {
  return std::hypot(farthest_px(side_px, radius_blocks), farthest_px(side_px, 0)) +
         side_px * std::sqrt(0.5);
}

double ClosingTier::reach_px() const { return least_radius_px() + side_px * std::sqrt(0.5); }

void close_free_depth(const Camera& camera, double detection_capability_m,
                      ClosingWorkspace& workspace, DepthImage& own_m) {
  if (!(detection_capability_m > 0) || own_m.pixels().empty()) return;
  Closing(camera, detection_capability_m, workspace, own_m).run();
}

}  // namespace berth
#endif  // HWY_ONCE
