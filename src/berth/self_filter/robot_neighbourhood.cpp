#include "berth/self_filter/robot_neighbourhood.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace berth {
namespace {

constexpr int kTileSide = 8;
constexpr float kFar = std::numeric_limits<float>::infinity();

struct Interval {
  double low;
  double high;
};

/// Where along one image axis a robot pixel may lie that is within `radius_m` of `position_m`, if
/// its depth is in [depth.low, depth.high]; pixels from the principal point.
Interval window_px(double position_m, double radius_m, double focal_px, const Interval& depth_m) {
  const double low = (position_m - radius_m) * focal_px;
  const double high = (position_m + radius_m) * focal_px;
  return {std::min(low / depth_m.low, low / depth_m.high),
          std::max(high / depth_m.low, high / depth_m.high)};
}

/// First and last tile of those pixels; the first is after the last where there is none.
std::pair<int, int> tile_range(const Interval& window, double principal_px, int size_px) {
  const double first = std::max(0.0, std::floor(window.low + principal_px));
  const double last = std::min(size_px - 1.0, std::ceil(window.high + principal_px));
  if (first > last) return {0, -1};
  return {static_cast<int>(first) / kTileSide, static_cast<int>(last) / kTileSide};
}

}  // namespace

void RobotNeighbourhood::build(const Camera& camera, const RobotImage& robot) {
  camera_ = camera;
  robot_ = &robot;
  columns_ = (camera.width_px + kTileSide - 1) / kTileSide;
  rows_ = (camera.height_px + kTileSide - 1) / kTileSide;
  tiles_.assign(static_cast<std::size_t>(columns_) * rows_, {kFar, -kFar});
  for (int v = 0; v < camera.height_px; ++v) {
    for (int u = 0; u < camera.width_px; ++u) {
      const LinkId id = robot.link_id(u, v);
      if (id == kNoLink || id == kEnvironmentLink) continue;
      Tile& tile = tiles_[static_cast<std::size_t>(v / kTileSide) * columns_ + u / kTileSide];
      tile.nearest_m = std::min(tile.nearest_m, robot.depth_m(u, v));
      tile.farthest_m = std::max(tile.farthest_m, robot.depth_m(u, v));
    }
  }
  nearest_m_ = kFar;
  farthest_m_ = -kFar;
  bounds_ = {columns_, rows_, 0, 0};
  for (int row = 0; row < rows_; ++row) {
    for (int column = 0; column < columns_; ++column) {
      const Tile& tile = tiles_[static_cast<std::size_t>(row) * columns_ + column];
      if (tile.nearest_m == kFar) continue;
      nearest_m_ = std::min(nearest_m_, tile.nearest_m);
      farthest_m_ = std::max(farthest_m_, tile.farthest_m);
      bounds_ = {std::min(bounds_.u_begin, column), std::min(bounds_.v_begin, row),
                 std::max(bounds_.u_end, column + 1), std::max(bounds_.v_end, row + 1)};
    }
  }
}

PixelRect RobotNeighbourhood::reach(double radius_m) const {
  if (bounds_.empty()) return {};
  // What is within the radius may be nearer to the camera than the robot, and so farther out in the
  // image.
  if (nearest_m_ <= radius_m) return {0, 0, camera_.width_px, camera_.height_px};
  const double shift = nearest_m_ / (nearest_m_ - radius_m);
  const auto outward = [&](double from_centre_px, double focal_px, double sign) {
    const double stretched =
        sign * from_centre_px > 0 ? from_centre_px * shift : from_centre_px / (2 - 1 / shift);
    return stretched + sign * (radius_m * focal_px / (nearest_m_ - radius_m) + 1);
  };
  const auto clamp_to = [](double value, int limit) {
    return static_cast<int>(std::clamp<double>(value, 0, limit));
  };
  const double left =
      outward(bounds_.u_begin * kTileSide - camera_.cx_px, camera_.fx_px, -1) + camera_.cx_px;
  const double right =
      outward(bounds_.u_end * kTileSide - camera_.cx_px, camera_.fx_px, 1) + camera_.cx_px;
  const double top =
      outward(bounds_.v_begin * kTileSide - camera_.cy_px, camera_.fy_px, -1) + camera_.cy_px;
  const double bottom =
      outward(bounds_.v_end * kTileSide - camera_.cy_px, camera_.fy_px, 1) + camera_.cy_px;
  return {
      clamp_to(std::floor(left), camera_.width_px), clamp_to(std::floor(top), camera_.height_px),
      clamp_to(std::ceil(right), camera_.width_px), clamp_to(std::ceil(bottom), camera_.height_px)};
}

bool RobotNeighbourhood::is_near(int u, int v, double depth_m, double radius_m) const {
  const Interval depths_m{std::max<double>(depth_m - radius_m, nearest_m_),
                          std::min<double>(depth_m + radius_m, farthest_m_)};
  if (!(depths_m.low <= depths_m.high)) return false;
  const Eigen::Vector3d p_C((u - camera_.cx_px) * depth_m / camera_.fx_px,
                            (v - camera_.cy_px) * depth_m / camera_.fy_px, depth_m);
  const auto [left, right] = tile_range(window_px(p_C.x(), radius_m, camera_.fx_px, depths_m),
                                        camera_.cx_px, camera_.width_px);
  const auto [top, bottom] = tile_range(window_px(p_C.y(), radius_m, camera_.fy_px, depths_m),
                                        camera_.cy_px, camera_.height_px);
  for (int row = top; row <= bottom; ++row) {
    for (int column = left; column <= right; ++column) {
      const Tile& tile = tiles_[static_cast<std::size_t>(row) * columns_ + column];
      if (tile.nearest_m > depths_m.high || tile.farthest_m < depths_m.low) continue;
      if (any_pixel_near(column, row, p_C, radius_m * radius_m)) return true;
    }
  }
  return false;
}

bool RobotNeighbourhood::any_pixel_near(int column, int row, const Eigen::Vector3d& p_C,
                                        double radius2_m2) const {
  const int u_end = std::min(camera_.width_px, (column + 1) * kTileSide);
  const int v_end = std::min(camera_.height_px, (row + 1) * kTileSide);
  for (int v = row * kTileSide; v < v_end; ++v) {
    for (int u = column * kTileSide; u < u_end; ++u) {
      const LinkId id = robot_->link_id(u, v);
      if (id == kNoLink || id == kEnvironmentLink) continue;
      const double z = robot_->depth_m(u, v);
      const double dx = (u - camera_.cx_px) * z / camera_.fx_px - p_C.x();
      const double dy = (v - camera_.cy_px) * z / camera_.fy_px - p_C.y();
      const double dz = z - p_C.z();
      if (dx * dx + dy * dy + dz * dz <= radius2_m2) return true;
    }
  }
  return false;
}

}  // namespace berth
