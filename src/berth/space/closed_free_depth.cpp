#include "berth/space/closed_free_depth.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#ifndef BERTH_CLOSED_FREE_DEPTH
#define BERTH_CLOSED_FREE_DEPTH
namespace berth {

/// Zeros beside a row of the image: as far as a tier looks, and a vector.
constexpr int kClosingMargin_px = 64;
/// As far as the tiers look beyond a pixel or block.
constexpr int kClosingReach = 6;

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
  DepthUnits* first = nullptr;
  int stride = 0;
  /// Row y of the runs that reach so far to both sides.
  DepthUnits* row(int reach_px, int y) const {
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
    const DepthUnits* const from = ring.row(reach - 1, y);
    DepthUnits* const to = ring.row(reach, y);
    for (int x = begin + reach; x < end - reach; x += kShorts) {
      auto of_run = take(load_shorts(from + x - 1), load_shorts(from + x + 1));
      if (reach == 1) of_run = take(of_run, load_shorts(from + x));
      store_shorts(of_run, to + x);
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
                           DepthUnits* out, Take take) {
  for (int x = begin; x < end; x += kShorts) {
    auto all = load_shorts(ring.row(disc.reach(0), y) + x);
    for (int dy = 1; dy <= disc.last_row; ++dy) {
      const int reach = disc.reach(dy);
      all = take(all, take(load_shorts(ring.row(reach, y - dy) + x),
                           load_shorts(ring.row(reach, y + dy) + x)));
    }
    store_shorts(all, out + x);
  }
}

void fill_greatest_of_discs(const RunRing& ring, const DiscRows& disc, int y, int begin, int end,
                            DepthUnits* out) {
  fill_discs(ring, disc, y, begin, end, out, TakeGreatest());
}
void fill_least_of_discs(const RunRing& ring, const DiscRows& disc, int y, int begin, int end,
                         DepthUnits* out) {
  fill_discs(ring, disc, y, begin, end, out, TakeLeast());
}

/// max(self, min of the four neighbours).
void fill_pairs(const DepthUnits* above, const DepthUnits* middle, const DepthUnits* below,
                int width, DepthUnits* out) {
  for (int x = 0; x < width; x += kShorts) {
    const auto of_neighbours =
        hn::Min(hn::Min(load_shorts(above + x), load_shorts(below + x)),
                hn::Min(load_shorts(middle + x - 1), load_shorts(middle + x + 1)));
    store_shorts(hn::Max(load_shorts(middle + x), of_neighbours), out + x);
  }
}

/// Where `out` is below `top` it stays; elsewhere it becomes what the next tier says, but at
/// least that.
void go_on_from(const DepthUnits* next, DepthUnits top, int width, DepthUnits* out) {
  const ShortTag d;
  const auto tops = hn::Set(d, top);
  for (int x = 0; x < width; x += kShorts) {
    const auto was = load_shorts(out + x);
    const auto is_settled = hn::Lt(was, tops);
    store_shorts(hn::IfThenElse(is_settled, was, hn::Max(tops, load_shorts(next + x))), out + x);
  }
}

/// Whether some number is at least this; what stands beyond the row's end counts, and is 0.
bool has_at_least(const DepthUnits* row, DepthUnits least, int width) {
  const ShortTag d;
  auto most = hn::Zero(d);
  for (int x = 0; x < width; x += kShorts) most = hn::Max(most, load_shorts(row + x));
  return !hn::AllTrue(d, hn::Lt(most, hn::Set(d, least)));
}

/// The greatest of each 2 x 2 pixels of two rows. Such loops are the compiler's to make vectors of.
void fill_blocks(const DepthUnits* above, const DepthUnits* below, int count,
                 DepthUnits* HWY_RESTRICT out) {
  for (int i = 0; i < count; ++i) {
    const DepthUnits first = std::max(above[2 * i], below[2 * i]);
    const DepthUnits second = std::max(above[2 * i + 1], below[2 * i + 1]);
    out[i] = std::max(first, second);
  }
}

/// Each number twice.
void fill_twice(const DepthUnits* from, int count, DepthUnits* HWY_RESTRICT out) {
  for (int i = 0; i < count; ++i) out[2 * i] = out[2 * i + 1] = from[i];
}

/// Raises depths to these, at most `most`, less `half`.
void raise(const DepthUnits* closed, DepthUnits most, DepthUnits half, int width, DepthUnits* own) {
  const ShortTag d;
  for_row<kShorts>(
      0, width,
      [&](int u) {
        const auto capped = hn::Min(load_shorts(closed + u), hn::Set(d, most));
        const auto raised = hn::SaturatedSub(capped, hn::Set(d, half));
        store_shorts(hn::Max(raised, load_shorts(own + u)), own + u);
      },
      [&](int u) {
        const DepthUnits capped = std::min(closed[u], most);
        own[u] = std::max<DepthUnits>(own[u], capped > half ? capped - half : 0);
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
HWY_EXPORT(raise);

namespace {

/// From a block's middle to the nearest and the farthest pixel of the one that is this number of
/// blocks away, along an axis.
double nearest_px(int side_px, int blocks) {
  return blocks == 0 ? (side_px - 1) / 2.0 : side_px * blocks - (side_px - 1) / 2.0;
}
double farthest_px(int side_px, int blocks) { return side_px * blocks + (side_px - 1) / 2.0; }

/// All blocks within this distance, in blocks, of one.
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
          UnitImage& own)
      : width_(own.width()),
        height_(own.height()),
        stride_(width_ + 2 * kClosingMargin_px),
        ball_px_m_(std::min(camera.fx_px, camera.fy_px) * detection_capability_m / 2),
        half_(units_up(detection_capability_m / 2)),
        workspace_(workspace),
        own_(own),
        rows_end_(height_) {
    if (workspace.width == width_ && workspace.height == height_) return;
    workspace.width = width_;
    workspace.height = height_;
    workspace.rows.assign(std::size_t(first_scratch() + 2) * stride_, 0);
    workspace.rings.assign(std::size_t(2) * RunRing::kRows * (kClosingReach + 1) * stride_, 0);
  }

  void run() {
    for (int v = 0; v < height_; ++v) {
      std::copy_n(own_.row(v), width_, own_row(1, v));
    }
    for (int v = 0; v < (height_ + 1) / 2; ++v) {
      HWY_DYNAMIC_DISPATCH(fill_blocks)
      (own_row(1, 2 * v), own_row(1, 2 * v + 1), (width_ + 1) / 2, own_row(2, v));
    }
    for (const ClosingTier& tier : kClosingTiers) {
      if (rows_begin_ >= rows_end_) break;
      close(tier);
      go_on_above(top(tier.least_radius_px()));
    }
    for (int v = rows_begin_; v < rows_end_; ++v) {
      HWY_DYNAMIC_DISPATCH(fill_pairs)
      (own_row(1, v - 1), own_row(1, v), own_row(1, v + 1), width_, scratch(0));
      take(scratch(0), v);
    }
    const DepthUnits most = top(1);
    for (int v = 0; v < height_; ++v) {
      HWY_DYNAMIC_DISPATCH(raise)(closed_row(v), most, half_, width_, own_.row(v));
    }
  }

 private:
  /// The depth at which the ball covers discs of this radius.
  DepthUnits top(double radius_px) const {
    return static_cast<DepthUnits>(
        std::min(kUnitsPerMetre * ball_px_m_ / radius_px, 1.0 * kEndlessUnits));
  }
  int first_coarse() const { return height_ + 2 * kClosingReach; }
  int first_closed() const { return first_coarse() + (height_ + 1) / 2 + 2 * kClosingReach; }
  int first_scratch() const { return first_closed() + height_; }
  DepthUnits* at(int row) {
    return workspace_.rows.data() + static_cast<std::ptrdiff_t>(row) * stride_ + kClosingMargin_px;
  }
  /// A row of the image's blocks with this side.
  DepthUnits* own_row(int side_px, int v) {
    return at(kClosingReach + v + (side_px == 1 ? 0 : first_coarse()));
  }
  DepthUnits* closed_row(int v) { return at(first_closed() + v); }
  DepthUnits* scratch(int number) { return at(first_scratch() + number); }
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
      std::copy_n(own_row(side_px, v) - kClosingReach, width + 2 * kClosingReach,
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

  void take(const DepthUnits* next, int v) {
    HWY_DYNAMIC_DISPATCH(go_on_from)(next, before_, width_, closed_row(v));
    std::fill_n(closed_row(v) + width_, kClosingMargin_px, DepthUnits{0});
  }

  /// The next tier has something to say from this depth on, and in some rows nothing.
  void go_on_above(DepthUnits top) {
    before_ = top;
    const auto has_more = [&](int v) {
      return HWY_DYNAMIC_DISPATCH(has_at_least)(closed_row(v), top, width_);
    };
    while (rows_begin_ < rows_end_ && !has_more(rows_begin_)) ++rows_begin_;
    while (rows_begin_ < rows_end_ && !has_more(rows_end_ - 1)) --rows_end_;
  }

  int width_;
  int height_;
  int stride_;
  /// The ball's radius in the image at 1 m.
  double ball_px_m_;
  DepthUnits half_;
  ClosingWorkspace& workspace_;
  UnitImage& own_;
  int rows_begin_ = 0;
  int rows_end_;
  /// What the tiers before have an answer up to.
  DepthUnits before_ = 0;
};

}  // namespace

double ClosingTier::least_radius_px() const {
  return std::hypot(farthest_px(side_px, radius_blocks), farthest_px(side_px, 0)) +
         side_px * std::sqrt(0.5);
}

double ClosingTier::reach_px() const { return least_radius_px() + side_px * std::sqrt(0.5); }

void close_free_depth(const Camera& camera, double detection_capability_m,
                      ClosingWorkspace& workspace, UnitImage& own) {
  if (!(detection_capability_m > 0) || own.pixels().empty()) return;
  Closing(camera, detection_capability_m, workspace, own).run();
}

}  // namespace berth
#endif  // HWY_ONCE
