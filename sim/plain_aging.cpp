#include "sim/plain_aging.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "sim/plain_closing.hpp"
#include "sim/plain_hiding.hpp"

namespace berth::sim {
namespace {

/// Those that hold farther are taken together, in blocks of 2 x 2.
constexpr double kMostReach_px = 25;

/// What some pixels have left, and how far from them it holds; below 0 where there is nothing.
struct Holding {
  DepthImage left_m;
  Image<double> reach_px;

  Holding(int width, int height)
      : left_m(width, height, std::numeric_limits<float>::infinity()),
        reach_px(width, height, -1) {}
  bool is_far(int u, int v) const { return reach_px(u, v) > kMostReach_px; }
};

template <class Action>
void for_pixels(const DepthImage& image, Action action) {
  for (int v = 0; v < image.height(); ++v) {
    for (int u = 0; u < image.width(); ++u) action(u, v);
  }
}

Holding taken_together(const Holding& fine) {
  Holding out((fine.left_m.width() + 1) / 2, (fine.left_m.height() + 1) / 2);
  for_pixels(fine.left_m, [&](int u, int v) {
    if (!fine.is_far(u, v)) return;
    float& left_m = out.left_m(u / 2, v / 2);
    double& reach_px = out.reach_px(u / 2, v / 2);
    left_m = std::min(left_m, fine.left_m(u, v));
    reach_px = std::max(reach_px, fine.reach_px(u, v) / 2);
  });
  return out;
}

/// The minimum over each pixel's neighbourhood.
DepthImage held(const Holding& fine) {
  const int width = fine.left_m.width(), height = fine.left_m.height();
  DepthImage out(width, height, std::numeric_limits<float>::infinity());
  // In an image that is no larger, what holds farther holds everywhere.
  const bool is_last = std::max(width, height) < kMostReach_px;
  bool has_far = false;
  for_pixels(fine.left_m, [&](int u, int v) {
    has_far |= fine.is_far(u, v);
    if (fine.is_far(u, v) && !is_last) return;
    const int reach = static_cast<int>(std::ceil(std::min(fine.reach_px(u, v), kMostReach_px)));
    for (int y = std::max(0, v - reach); y <= std::min(height - 1, v + reach); ++y) {
      for (int x = std::max(0, u - reach); x <= std::min(width - 1, u + reach); ++x) {
        out(x, y) = std::min(out(x, y), fine.left_m(u, v));
      }
    }
  });
  if (!has_far || is_last) return out;
  const DepthImage coarse_m = held(taken_together(fine));
  for_pixels(out, [&](int u, int v) { out(u, v) = std::min(out(u, v), coarse_m(u / 2, v / 2)); });
  return out;
}

}  // namespace

DepthImage plainly_aged(const Camera& camera, const DepthImage& sensor_depth_m,
                        const DepthImage& own_m, const DepthImage& environment_front_m,
                        double moved_m) {
  const int width = own_m.width(), height = own_m.height();
  const double spread_px_m = std::max(camera.fx_px, camera.fy_px) * moved_m;
  const auto counted_moved_m = static_cast<float>(plainly_counted_up(moved_m));
  Holding all(width, height);
  for_pixels(own_m, [&](int u, int v) {
    const double sensed_m = plainly_counted(sensor_depth_m(u, v));
    all.left_m(u, v) = std::max(0.0F, own_m(u, v) - counted_moved_m);
    // One more for the least of 3 x 3 pixels.
    all.reach_px(u, v) = 1;
    if (!std::isnan(sensed_m) && moved_m > 0) {
      all.reach_px(u, v) += std::ceil(spread_px_m / sensed_m);
    }
    // Nothing comes out of a solid, and nothing is before it.
    const double solid_m = plainly_hidden_to(environment_front_m, {u, v});
    if (solid_m <= own_m(u, v) && sensed_m < own_m(u, v)) {
      all.left_m(u, v) = std::max(all.left_m(u, v), static_cast<float>(solid_m));
      all.reach_px(u, v) = 1;
    }
  });
  DepthImage out = held(all);
  for_pixels(out, [&](int u, int v) {
    if (u == 0 || v == 0 || u == width - 1 || v == height - 1) out(u, v) = 0;
  });
  return out;
}

}  // namespace berth::sim
