#include "berth/space/robot_holes.hpp"

#include <algorithm>
#include <cmath>

namespace berth {
namespace {

constexpr std::uint8_t kNoRow = kMostRobotHole_px + 1;

void set_size(const DepthImage& like, Image<std::uint8_t>& image) {
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
  RobotHoles(double ball_px_m, DepthView sensor_depth_m, const ObstacleImage& obstacles,
             RobotHolesWorkspace& workspace, DepthImage& own_m)
      : ball_px_m_(ball_px_m),
        sensor_depth_m_(sensor_depth_m),
        obstacles_(obstacles),
        workspace_(workspace),
        own_m_(own_m) {
    set_size(own_m, workspace.above);
    set_size(own_m, workspace.below);
    workspace.none.assign(own_m.width(), kNoRow);
  }

  void run() {
    count_all_rows();
    for (int v = 0; v < own_m_.height(); ++v) free_row(v);
  }

 private:
  void count_all_rows() {
    const int width = own_m_.width();
    const std::uint8_t* before = workspace_.none.data();
    for (int v = 0; v < own_m_.height(); ++v) {
      count_rows(obstacles_.fate.row(v), before, width, workspace_.above.row(v));
      before = workspace_.above.row(v);
    }
    before = workspace_.none.data();
    for (int v = own_m_.height() - 1; v >= 0; --v) {
      count_rows(obstacles_.fate.row(v), before, width, workspace_.below.row(v));
      before = workspace_.below.row(v);
    }
  }

  /// Blocks of columns without a hole, or far from the robot, are passed over.
  void free_row(int v) {
    constexpr int kBlock_px = 16;
    const float* const own_m = own_m_.row(v);
    for (int begin = 0; begin < own_m_.width(); begin += kBlock_px) {
      const int end = std::min(begin + kBlock_px, own_m_.width());
      int without = 0;
      for (int u = begin; u < end; ++u) without += int(!(own_m[u] > 0));
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
    for (int u = std::max(begin, 0); u < std::min(end, own_m_.width()); ++u) {
      least = std::min({least, above[u], below[u]});
    }
    return least < kNoRow;
  }

  /// A hole that was freed before shows no robot: nobody goes on from it.
  bool is_hole(int u, int v) const {
    return !(own_m_(u, v) > 0) && std::isnan(sensor_depth_m_(u, v)) &&
           std::isnan(obstacles_.depth_m(u, v));
  }

  void free_hole(int u, int v) {
    int least2_px2 = kMostRobotHole_px * kMostRobotHole_px + 1;
    float frees_m = 0;
    const auto take = [&](int distance2_px2, float m) {
      if (distance2_px2 > least2_px2) return;
      frees_m = distance2_px2 < least2_px2 ? m : std::max(frees_m, m);
      least2_px2 = distance2_px2;
    };
    const auto take_column = [&](int x) {
      if (x < 0 || x >= own_m_.width()) return;
      const int above = workspace_.above(x, v);
      const int below = workspace_.below(x, v);
      const int aside2 = (x - u) * (x - u);
      if (above < kNoRow) take(aside2 + above * above, own_m_(x, v - above));
      if (below < kNoRow) take(aside2 + below * below, own_m_(x, v + below));
    };
    take_column(u);
    for (int aside = 1; aside <= kMostRobotHole_px && aside * aside <= least2_px2; ++aside) {
      take_column(u - aside);
      take_column(u + aside);
    }
    if (!(frees_m > 0)) return;
    const double reach_px = ball_px_m_ / frees_m - kHalfDiagonal_px;
    if (reach_px > 0 && least2_px2 <= reach_px * reach_px) own_m_(u, v) = frees_m;
  }

  double ball_px_m_;
  DepthView sensor_depth_m_;
  const ObstacleImage& obstacles_;
  RobotHolesWorkspace& workspace_;
  DepthImage& own_m_;
};

}  // namespace

void free_holes_beside_robot(const Camera& camera, DepthView sensor_depth_m,
                             const ObstacleImage& obstacles, double detection_capability_m,
                             RobotHolesWorkspace& workspace, DepthImage& own_m) {
  if (!(detection_capability_m > 0) || own_m.pixels().empty()) return;
  const double ball_px_m = std::min(camera.fx_px, camera.fy_px) * detection_capability_m / 2;
  RobotHoles(ball_px_m, sensor_depth_m, obstacles, workspace, own_m).run();
}

}  // namespace berth
