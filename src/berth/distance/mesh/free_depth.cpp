#include "berth/distance/mesh/free_depth.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace berth {
namespace {

constexpr float kEndless = std::numeric_limits<float>::max();

bool is_empty(float sensed_m, float obstacle_m) {
  return std::isnan(sensed_m) && std::isnan(obstacle_m);
}

float own_of_reading(float sensed_m, float obstacle_m, PixelFate fate, float margin_m,
                     float behind_m) {
  switch (fate) {
    case PixelFate::background:
      return std::isnan(sensed_m) ? 0 : std::min(obstacle_m - margin_m, sensed_m + behind_m);
    case PixelFate::robot:
    case PixelFate::environment:
    case PixelFate::padding:
    case PixelFate::dilation:
      return sensed_m + behind_m;
    case PixelFate::edge:
    case PixelFate::island:
    case PixelFate::speckle:
    case PixelFate::outside_region:
      return sensed_m - margin_m;
    case PixelFate::obstacle:
    case PixelFate::no_reading:
    case PixelFate::averaged:
    case PixelFate::hole:
      break;
  }
  return obstacle_m - margin_m;
}

float own_of_hole(DepthView sensor_depth_m, const ObstacleImage& obstacles, int u, int v,
                  float margin_m, float behind_m) {
  constexpr int kLeastNeighbours = 5;
  int readings = 0;
  float least_m = kEndless;
  const PixelRect around =
      clip({u - 1, v - 1, u + 2, v + 2}, sensor_depth_m.width, sensor_depth_m.height);
  for (int y = around.v_begin; y < around.v_end; ++y) {
    for (int x = around.u_begin; x < around.u_end; ++x) {
      const float sensed_m = sensor_depth_m(x, y);
      if (std::isnan(sensed_m)) continue;
      ++readings;
      least_m = std::min(least_m, own_of_reading(sensed_m, obstacles.depth_m(x, y),
                                                 obstacles.fate(x, y), margin_m, behind_m));
    }
  }
  return readings >= kLeastNeighbours ? least_m : 0;
}

}  // namespace

void find_own_free_depth(DepthView sensor_depth_m, const ObstacleImage& obstacles,
                         const SpaceSettings& settings, DepthImage& out) {
  const auto margin_m = static_cast<float>(settings.carve_margin_m);
  const auto behind_m = static_cast<float>(settings.behind_robot_m);
  out.resize(sensor_depth_m.width, sensor_depth_m.height, 0);
  for (int v = 0; v < sensor_depth_m.height; ++v) {
    for (int u = 0; u < sensor_depth_m.width; ++u) {
      const float sensed_m = sensor_depth_m(u, v);
      const float obstacle_m = obstacles.depth_m(u, v);
      float own_m;
      if (!is_empty(sensed_m, obstacle_m)) {
        own_m = own_of_reading(sensed_m, obstacle_m, obstacles.fate(u, v), margin_m, behind_m);
      } else if (settings.no_reading == NoReading::free) {
        own_m = kEndless;
      } else {
        own_m = own_of_hole(sensor_depth_m, obstacles, u, v, margin_m, behind_m);
      }
      out(u, v) = own_m > 0 ? own_m : 0;
    }
  }
}

void find_free_depth(const DepthImage& own_m, DepthImage& out) {
  out.resize(own_m.width(), own_m.height(), 0);
  for (int v = 1; v + 1 < own_m.height(); ++v) {
    for (int u = 1; u + 1 < own_m.width(); ++u) {
      float least_m = kEndless;
      for (int y = v - 1; y <= v + 1; ++y) {
        for (int x = u - 1; x <= u + 1; ++x) least_m = std::min(least_m, own_m(x, y));
      }
      out(u, v) = least_m;
    }
  }
}

namespace {

/// Makes `value` hold in all pixels of `rect`, by squares of the greatest size that fits.
void hold_in(const PixelRect& rect, float value, std::vector<DepthImage>& levels) {
  const int width = rect.u_end - rect.u_begin;
  const int height = rect.v_end - rect.v_begin;
  const int level = static_cast<int>(std::log2(std::min(width, height)));
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

/// Each square's value holds in its four quarters.
void hold_in_quarters(const DepthImage& squares, int half, DepthImage& quarters) {
  for (int v = 0; v + 2 * half <= squares.height(); ++v) {
    for (int u = 0; u + 2 * half <= squares.width(); ++u) {
      const float value = squares(u, v);
      for (const int y : {v, v + half}) {
        for (const int x : {u, u + half}) quarters(x, y) = std::min(quarters(x, y), value);
      }
    }
  }
}

}  // namespace

void age_own_free_depth(const Camera& camera, const DepthImage& sensor_depth_m,
                        const DepthImage& own_m, double moved_m, AgingWorkspace& workspace,
                        DepthImage& out) {
  const int width = own_m.width();
  const int height = own_m.height();
  out.resize(width, height, 0);
  if (width == 0 || height == 0) return;
  const auto level_count = static_cast<std::size_t>(std::log2(std::min(width, height))) + 1;
  workspace.levels.resize(std::max(workspace.levels.size(), level_count));
  for (std::size_t k = 0; k < level_count; ++k) workspace.levels[k].resize(width, height, kEndless);
  DepthImage& pixels = workspace.levels[0];
  const double spread = std::max(camera.fx_px, camera.fy_px) * moved_m;
  for (int v = 0; v < height; ++v) {
    for (int u = 0; u < width; ++u) {
      const float left_m = std::max(0.0f, own_m(u, v) - static_cast<float>(moved_m));
      pixels(u, v) = std::min(pixels(u, v), left_m);
      const float sensed_m = sensor_depth_m(u, v);
      if (std::isnan(sensed_m)) continue;
      const int reach =
          static_cast<int>(std::min(std::ceil(spread / sensed_m), width + height + 0.0));
      hold_in(clip({u - reach, v - reach, u + reach + 1, v + reach + 1}, width, height), left_m,
              workspace.levels);
    }
  }
  for (std::size_t k = level_count - 1; k > 0; --k) {
    hold_in_quarters(workspace.levels[k], 1 << (k - 1), workspace.levels[k - 1]);
  }
  out.pixels() = pixels.pixels();
}

}  // namespace berth
