#include "berth/space/aged_depth.hpp"

#include <algorithm>

#include "berth/vector/divide_up.hpp"

#ifndef BERTH_AGED_DEPTH_ROWS
#define BERTH_AGED_DEPTH_ROWS
namespace berth {
/// Two rows of an image, which become one.
struct RowPair {
  const DepthUnits* sensed[2];
  const DepthUnits* own[2];
  /// Readings before this one reach far.
  DepthUnits far = 0;
  DepthUnits moved = 0;
  int width = 0;
};
}  // namespace berth
#endif

// Compiles the rest of this file once for each instruction set.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "berth/space/aged_depth.cpp"
#include "hwy/foreach_target.h"
#include "hwy/highway.h"

HWY_BEFORE_NAMESPACE();
namespace berth {
namespace HWY_NAMESPACE {

/// Of what reaches far in two rows the least in each column: its reading, and what it has left.
void fill_far(const RowPair& rows, DepthUnits* HWY_RESTRICT sensed, DepthUnits* HWY_RESTRICT left) {
  const auto of_row = [&](int i, int u) {
    return rows.sensed[i][u] < rows.far ? rows.sensed[i][u] : kEndlessUnits;
  };
  const auto left_in_row = [&](int i, int u) {
    return rows.sensed[i][u] < rows.far ? left_of(rows.own[i][u], rows.moved) : kEndlessUnits;
  };
  for (int u = 0; u < rows.width; ++u) {
    sensed[u] = std::min(of_row(0, u), of_row(1, u));
    left[u] = std::min(left_in_row(0, u), left_in_row(1, u));
  }
}

/// Lets what ends at a solid hold for itself alone, with the solid's front left.
void close_solids(const DepthUnits* solid_to_end, DepthUnits moved, int width,
                  DepthUnits* HWY_RESTRICT sensed, DepthUnits* HWY_RESTRICT own) {
  for (int u = 0; u < width; ++u) {
    const auto front = static_cast<DepthUnits>(kEndlessUnits - solid_to_end[u]);
    const auto kept = static_cast<DepthUnits>(std::min(front + moved, int{kMostUnits}));
    const bool ends = own[u] >= front && own[u] > sensed[u];
    own[u] = ends ? std::max(own[u], kept) : own[u];
    sensed[u] = ends ? kEndlessUnits : sensed[u];
  }
}

/// The least of each two neighbours.
void halve(const DepthUnits* from, int count, DepthUnits* HWY_RESTRICT out) {
  for (int i = 0; i < count; ++i) out[i] = std::min(from[2 * i], from[2 * i + 1]);
}

}  // namespace HWY_NAMESPACE
}  // namespace berth
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace berth {

HWY_EXPORT(fill_far);
HWY_EXPORT(close_solids);
HWY_EXPORT(halve);

namespace {

/// One image's way through the levels.
class Aging {
 public:
  Aging(double spread_m, AgingWorkspace& workspace) : spread_m_(spread_m), workspace_(workspace) {}

  /// What this level's pixels hold, and those that it was made of reach far.
  void run(std::size_t n, const UnitImage& sensor_depth, const UnitImage& own, DepthUnits moved,
           DepthUnits* out) {
    LevelImages images{sensor_depth, own, moved, ring_borders(spread_m_, 1 << n), nullptr, n == 0};
    // The greatest ring holds for an image that is no larger.
    const bool is_last = std::max(own.width(), own.height()) <= kMostRing;
    if (is_last) images.borders[kMostRing] = 0;
    if (find_rings(images, workspace_.levels[n].rings)) {
      AgingWorkspace::Level& next = workspace_.levels[n + 1];
      take_together(images, workspace_.levels[n].rings, next);
      run(n + 1, next.sensor_depth, next.left, 0, next.held.pixels().data());
      images.beyond = &next.held;
    }
    hold_rings(images, workspace_.levels[n], workspace_, out);
  }

 private:
  /// Fills the next level with what reaches far.
  void take_together(const LevelImages& images, const std::vector<std::uint32_t>& rings,
                     AgingWorkspace::Level& next) {
    const int width = images.own.width();
    const int height = images.own.height();
    const int columns = divide_up(width, 2);
    for (UnitImage* image : {&next.sensor_depth, &next.left, &next.held}) {
      set_size(columns, divide_up(height, 2), *image);
    }
    for (auto& row : workspace_.far) row.assign(2 * columns, kEndlessUnits);
    for (int v = 0; v < height; v += 2) {
      const int below = std::min(v + 1, height - 1);
      if (!reaches_far(images, rings, v) && !reaches_far(images, rings, below)) {
        std::fill_n(next.sensor_depth.row(v / 2), columns, kEndlessUnits);
        std::fill_n(next.left.row(v / 2), columns, kEndlessUnits);
        continue;
      }
      const UnitImage& sensed = images.sensor_depth;
      const RowPair rows{{sensed.row(v), sensed.row(below)},
                         {images.own.row(v), images.own.row(below)},
                         images.borders[kMostRing],
                         images.moved,
                         width};
      auto& [far_sensed, far_left] = workspace_.far;
      HWY_DYNAMIC_DISPATCH(fill_far)(rows, far_sensed.data(), far_left.data());
      HWY_DYNAMIC_DISPATCH(halve)(far_sensed.data(), columns, next.sensor_depth.row(v / 2));
      HWY_DYNAMIC_DISPATCH(halve)(far_left.data(), columns, next.left.row(v / 2));
    }
  }

  double spread_m_;
  AgingWorkspace& workspace_;
};

}  // namespace

void age_free_depth(const Camera& camera, const UnitImage& sensor_depth, const UnitImage& own,
                    const DepthWindows* solid_to_end, double moved_m, AgingWorkspace& workspace,
                    DepthWindows& out) {
  DepthWindows::Level& image = begin_depth_windows(own.width(), own.height(), out);
  if (own.pixels().empty()) return;
  const DepthUnits moved = units_up(moved_m);
  Aging aging(std::max(camera.fx_px, camera.fy_px) * moved_m, workspace);
  if (solid_to_end == nullptr) {
    aging.run(0, sensor_depth, own, moved, image.row(0));
    return;
  }
  workspace.sensor_depth = sensor_depth;
  workspace.own = own;
  for (int v = 0; v < own.height(); ++v) {
    HWY_DYNAMIC_DISPATCH(close_solids)
    (solid_to_end->levels[0].row(v), moved, own.width(), workspace.sensor_depth.row(v),
     workspace.own.row(v));
  }
  aging.run(0, workspace.sensor_depth, workspace.own, moved, image.row(0));
}

}  // namespace berth
#endif  // HWY_ONCE
