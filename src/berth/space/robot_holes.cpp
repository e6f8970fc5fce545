#include "berth/space/robot_holes.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace berth {
namespace {

constexpr std::uint8_t kNoRow = kMostRobotHole_px + 1;

/// A number for each quarter of a pixel.
using Quarters = std::array<float, 4>;

/// One over how far the middle of a pixel is, at most, from a point in each quarter of another one.
class QuarterReach {
 public:
  QuarterReach() {
    for (int y = -kMostRobotHole_px; y <= kMostRobotHole_px; ++y) {
      for (int x = -kMostRobotHole_px; x <= kMostRobotHole_px; ++x) per_px_[place(x, y)] = of(x, y);
    }
  }
  const Quarters& at(int x, int y) const { return per_px_[place(x, y)]; }

 private:
  static constexpr int kSide = 2 * kMostRobotHole_px + 1;
  static std::size_t place(int x, int y) {
    return static_cast<std::size_t>((y + kMostRobotHole_px) * kSide + x + kMostRobotHole_px);
  }
  static Quarters of(int x, int y) {
    Quarters per_px;
    for (std::size_t i = 0; i < per_px.size(); ++i) {
      const double far_x = std::max<double>(std::abs(x), std::abs(x - (i & 1 ? 0.5 : -0.5)));
      const double far_y = std::max<double>(std::abs(y), std::abs(y - (i & 2 ? 0.5 : -0.5)));
      per_px[i] = static_cast<float>(1 / std::hypot(far_x, far_y));
    }
    return per_px;
  }
  std::array<Quarters, kSide * kSide> per_px_;
};
const QuarterReach kReach;

void set_size(const UnitImage& like, Image<std::uint8_t>& image) {
  if (image.width() == like.width() && image.height() == like.height()) return;
  image.resize(like.width(), like.height(), kNoRow);
}

/// The rows to the next pixel that shows the robot, from those of the row before. Such loops are
/// the compiler's to make vectors of.
void count_rows(const PixelFate* fate, const std::uint8_t* before, int width,
                std::uint8_t* __restrict rows) {
  for (int u = 0; u < width; ++u) {
    const auto next = static_cast<std::uint8_t>(before[u] + (before[u] < kNoRow ? 1 : 0));
    rows[u] = fate[u] == PixelFate::robot ? 0 : next;
  }
}

/// One image's holes.
class RobotHoles {
 public:
  RobotHoles(float ball_px, DepthView sensor_depth_m, const ObstacleImage& obstacles,
             RobotHolesWorkspace& workspace, UnitImage& own)
      : ball_px_(ball_px),
        sensor_depth_m_(sensor_depth_m),
        obstacles_(obstacles),
        workspace_(workspace),
        own_(own) {
    set_size(own, workspace.above);
    set_size(own, workspace.below);
    workspace.none.assign(own.width(), kNoRow);
  }

  void run() {
    count_all_rows();
    for (int v = 0; v < own_.height(); ++v) free_row(v);
  }

 private:
  void count_all_rows() {
    const int width = own_.width();
    const std::uint8_t* before = workspace_.none.data();
    for (int v = 0; v < own_.height(); ++v) {
      count_rows(obstacles_.fate.row(v), before, width, workspace_.above.row(v));
      before = workspace_.above.row(v);
    }
    before = workspace_.none.data();
    for (int v = own_.height() - 1; v >= 0; --v) {
      count_rows(obstacles_.fate.row(v), before, width, workspace_.below.row(v));
      before = workspace_.below.row(v);
    }
  }

  /// Blocks of columns without a hole, or far from the robot, are passed over.
  void free_row(int v) {
    constexpr int kBlock_px = 16;
    const DepthUnits* const own = own_.row(v);
    for (int begin = 0; begin < own_.width(); begin += kBlock_px) {
      const int end = std::min(begin + kBlock_px, own_.width());
      int without = 0;
      for (int u = begin; u < end; ++u) without += int(own[u] == 0);
      if (without == 0 || !has_robot(begin - kMostRobotHole_px, end + kMostRobotHole_px, v)) {
        continue;
      }
      for (int u = begin; u < end; ++u) {
        if (is_hole(u, v)) free_hole(u, v);
      }
    }
  }

  bool has_robot(int begin, int end, int v) const {
    const std::uint8_t* const above = workspace_.above.row(v);
    const std::uint8_t* const below = workspace_.below.row(v);
    std::uint8_t least = kNoRow;
    for (int u = std::max(begin, 0); u < std::min(end, own_.width()); ++u) {
      least = std::min({least, above[u], below[u]});
    }
    return least < kNoRow;
  }

  /// A hole that was freed before shows no robot: nobody goes on from it.
  bool is_hole(int u, int v) const {
    return own_(u, v) == 0 && obstacles_.fate(u, v) != PixelFate::robot &&
           std::isnan(sensor_depth_m_(u, v)) &&
           (std::isnan(obstacles_.depth_m(u, v)) || obstacles_.fate(u, v) == PixelFate::hole);
  }

  void free_hole(int u, int v) {
    Quarters frees = {};
    const auto take_column = [&](int aside) {
      const int x = u + aside;
      if (x < 0 || x >= own_.width()) return;
      const int above = workspace_.above(x, v);
      const int below = workspace_.below(x, v);
      if (above < kNoRow) take(own_(x, v - above), kReach.at(aside, -above), frees);
      if (below < kNoRow) take(own_(x, v + below), kReach.at(aside, below), frees);
    };
    take_column(0);
    for (int aside = 1; aside <= kMostRobotHole_px; ++aside) {
      // Nobody farther aside can make it more.
      const float most = ball_px_ * *std::ranges::max_element(kReach.at(aside, 0));
      if (most <= *std::ranges::min_element(frees)) break;
      take_column(-aside);
      take_column(aside);
    }
    own_(u, v) = static_cast<DepthUnits>(*std::ranges::min_element(frees));
  }

  void take(DepthUnits robot_frees, const Quarters& per_px, Quarters& frees) const {
    for (std::size_t i = 0; i < frees.size(); ++i) {
      frees[i] = std::max(frees[i], std::min<float>(robot_frees, ball_px_ * per_px[i]));
    }
  }

  /// The ball's radius in the image at a depth of one unit.
  float ball_px_;
  DepthView sensor_depth_m_;
  const ObstacleImage& obstacles_;
  RobotHolesWorkspace& workspace_;
  UnitImage& own_;
};

}  // namespace

void free_holes_beside_robot(const Camera& camera, DepthView sensor_depth_m,
                             const ObstacleImage& obstacles, double detection_capability_m,
                             RobotHolesWorkspace& workspace, UnitImage& own) {
  if (!(detection_capability_m > 0) || own.pixels().empty()) return;
  const auto ball_px = kUnitsPerMetre * static_cast<float>(std::min(camera.fx_px, camera.fy_px) *
                                                           detection_capability_m / 2);
  RobotHoles(ball_px, sensor_depth_m, obstacles, workspace, own).run();
}

}  // namespace berth
