#include "sim/plain_closing.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <functional>
#include <limits>
#include <vector>

namespace berth::sim {
namespace {

constexpr double kCountsPerMetre = 2048;
constexpr int kMost = 65535;

/// The pixels (x, y) whose centres are within this of (0, 0).
std::vector<Pixel> pixels_within(double radius_px) {
  std::vector<Pixel> pixels;
  const int reach = static_cast<int>(std::ceil(radius_px));
  for (int y = -reach; y <= reach; ++y) {
    for (int x = -reach; x <= reach; ++x) {
      if (x * x + y * y <= radius_px * radius_px) pixels.push_back({x, y});
    }
  }
  return pixels;
}

/// Counted depths, 0 beside the image.
class Depths {
 public:
  explicit Depths(const DepthImage& depth_m) : counts_(depth_m.width(), depth_m.height(), 0) {
    for (int v = 0; v < depth_m.height(); ++v) {
      for (int u = 0; u < depth_m.width(); ++u) {
        counts_(u, v) = static_cast<int>(std::min(depth_m(u, v) * kCountsPerMetre, 1.0 * kMost));
      }
    }
  }
  int operator()(int u, int v) const {
    return u < 0 || v < 0 || u >= counts_.width() || v >= counts_.height() ? 0 : counts_(u, v);
  }

 private:
  Image<int> counts_;
};

/// Balls that cover all blocks of side x side pixels within `radius` blocks of one, wherever their
/// centres are.
class Discs {
 public:
  Discs(int side, int radius) : side_(side) {
    for (const Pixel& block : pixels_within(radius)) {
      for_block(block, [&](int x, int y) { covered_.push_back({x, y}); });
    }
    // Half a block's diagonal is as far as a ball's centre is from the middle of its block.
    for (const Pixel& p : covered_) least_radius_px_ = std::max(least_radius_px_, to_middle(p));
    least_radius_px_ += side * std::sqrt(0.5);
    const double reach_px = least_radius_px_ + side * std::sqrt(0.5);
    for (const Pixel& block : pixels_within(2 * radius + 4)) {
      bool is_reached = false;
      for_block(block, [&](int x, int y) { is_reached |= to_middle({x, y}) <= reach_px; });
      if (is_reached) reached_.push_back(block);
    }
  }

  double least_radius_px() const { return least_radius_px_; }

  /// The least depth at which such a disc that may hold (u, v) frees nothing deeper.
  int least_count(const Depths& counts, int u, int v) const {
    int least = kMost;
    for (const Pixel& block : reached_) {
      int greatest = 0;
      for (const Pixel& p : covered_) {
        greatest = std::max(greatest, counts((u / side_ + block.u) * side_ + p.u,
                                             (v / side_ + block.v) * side_ + p.v));
        if (greatest >= least) break;
      }
      least = std::min(least, greatest);
    }
    return least;
  }

 private:
  template <class Action>
  void for_block(const Pixel& block, Action action) const {
    for (int y = 0; y < side_; ++y) {
      for (int x = 0; x < side_; ++x) action(block.u * side_ + x, block.v * side_ + y);
    }
  }
  /// From the middle of the block (0, 0).
  double to_middle(const Pixel& p) const {
    return std::hypot(p.u - (side_ - 1) / 2.0, p.v - (side_ - 1) / 2.0);
  }

  int side_;
  double least_radius_px_ = 0;
  std::vector<Pixel> covered_;
  std::vector<Pixel> reached_;
};

/// The same for two pixels side by side.
int least_of_pairs(const Depths& counts, int u, int v) {
  int least = kMost;
  for (const Pixel& p : {Pixel{1, 0}, Pixel{-1, 0}, Pixel{0, 1}, Pixel{0, -1}}) {
    least = std::min(least, std::max(counts(u, v), counts(u + p.u, v + p.v)));
  }
  return least;
}

/// Where a disc stays as it is from this depth on, and the one that holds there.
struct Tier {
  int until;
  std::function<int(int u, int v)> least_count;
};

/// The middle of the pixel (x, y) from the farthest corner of a quarter of (0, 0): `right` and
/// `low` are 0 or 1.
double quarter_px(int x, int y, int right, int low) {
  double most_px = 0;
  for (const double across : {right - 0.5, 0.0}) {
    for (const double down : {low - 0.5, 0.0}) {
      most_px = std::max(most_px, std::hypot(x - across, y - down));
    }
  }
  return most_px;
}

/// From the robot's pixels within four rows and columns that no other one hides in its column.
float freed_by_robot_m(const Image<PixelFate>& fate, const DepthImage& own_m, double ball_px_m,
                       int u, int v) {
  constexpr int kMost_px = 4;
  std::array<float, 4> quarters_m = {};
  for (int x = std::max(u - kMost_px, 0); x <= std::min(u + kMost_px, fate.width() - 1); ++x) {
    for (const int step : {-1, 1}) {
      int y = v;
      const auto is_near = [&] {
        return y >= 0 && y < fate.height() && std::abs(y - v) <= kMost_px;
      };
      while (is_near() && fate(x, y) != PixelFate::robot) y += step;
      if (!is_near()) continue;
      for (int i = 0; i < 4; ++i) {
        const auto per_px = static_cast<float>(1 / quarter_px(x - u, y - v, i % 2, i / 2));
        const float most_m = std::min(own_m(x, y), static_cast<float>(ball_px_m) * per_px);
        quarters_m[i] = std::max(quarters_m[i], most_m);
      }
    }
  }
  return plainly_counted(*std::min_element(quarters_m.begin(), quarters_m.end()));
}

}  // namespace

float plainly_counted(float depth_m) {
  if (!(depth_m < std::numeric_limits<float>::max())) return depth_m;
  return static_cast<float>(std::min(std::floor(depth_m * kCountsPerMetre), kMost - 1.0) /
                            kCountsPerMetre);
}

double plainly_counted_up(double length_m) {
  return std::ceil(length_m * kCountsPerMetre) / kCountsPerMetre;
}

double plainly_told_m(const SpaceSettings& settings, const Camera& camera) {
  // A ball that covers a pixel, the four around it, and the middle of any pixel that it is in.
  const double radius_px = 1 + std::sqrt(0.5);
  const double suits_cm = 600 * radius_px / std::min(camera.fx_px, camera.fy_px);
  return settings.detection_capability_m.value_or(std::max(4.0, std::round(suits_cm)) / 100);
}

DepthImage plainly_freed_beside_robot(const Camera& camera, DepthView sensor_depth_m,
                                      DepthView obstacle_depth_m, const Image<PixelFate>& fate,
                                      const DepthImage& own_m, double detection_capability_m) {
  DepthImage freed_m = own_m;
  const double ball_px_m = std::min(camera.fx_px, camera.fy_px) * detection_capability_m / 2;
  for (int v = 0; v < own_m.height(); ++v) {
    for (int u = 0; u < own_m.width(); ++u) {
      const bool has_nothing = std::isnan(obstacle_depth_m(u, v)) || fate(u, v) == PixelFate::hole;
      const bool is_hole =
          std::isnan(sensor_depth_m(u, v)) && has_nothing && fate(u, v) != PixelFate::robot;
      if (!is_hole || own_m(u, v) > 0 || !(detection_capability_m > 0)) continue;
      freed_m(u, v) = freed_by_robot_m(fate, own_m, ball_px_m, u, v);
    }
  }
  return freed_m;
}

DepthImage plainly_closed(const Camera& camera, const DepthImage& own_m,
                          double detection_capability_m) {
  DepthImage closed_m = own_m;
  if (!(detection_capability_m > 0)) return closed_m;
  const Depths counts(own_m);
  const double ball_px_m = std::min(camera.fx_px, camera.fy_px) * detection_capability_m / 2;
  const auto depth_of = [&](double radius_px) {
    return static_cast<int>(std::min(kCountsPerMetre * ball_px_m / radius_px, 1.0 * kMost));
  };
  std::vector<Tier> tiers;
  for (const Discs& discs : {Discs(2, 2), Discs(2, 1), Discs(1, 2), Discs(1, 1)}) {
    tiers.push_back({depth_of(discs.least_radius_px()),
                     [&counts, discs](int u, int v) { return discs.least_count(counts, u, v); }});
  }
  tiers.push_back({depth_of(1), [&counts](int u, int v) { return least_of_pairs(counts, u, v); }});
  for (int v = 0; v < own_m.height(); ++v) {
    for (int u = 0; u < own_m.width(); ++u) {
      int found = 0;
      for (const Tier& tier : tiers) {
        found = std::max(found, tier.least_count(u, v));
        if (found < tier.until) break;
        found = tier.until;
      }
      const double most_m =
          found / kCountsPerMetre - plainly_counted_up(detection_capability_m / 2);
      closed_m(u, v) = std::max(own_m(u, v), static_cast<float>(most_m));
    }
  }
  return closed_m;
}

}  // namespace berth::sim
