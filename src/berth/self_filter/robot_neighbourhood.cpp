#include "berth/self_filter/robot_neighbourhood.hpp"

#include <algorithm>
#include <limits>

namespace berth {
namespace {

constexpr int kTilePx = 8;
constexpr int kGroupTiles = 4;
constexpr float kNowhere = std::numeric_limits<float>::infinity();

PixelRect tile_pixels(int column, int row, int width, int height) {
  return {column * kTilePx, row * kTilePx, std::min(width, (column + 1) * kTilePx),
          std::min(height, (row + 1) * kTilePx)};
}

template <typename Point>
float squared_distance_m2(const Point& a, const Point& b) {
  const float dx = a.x_m - b.x_m;
  const float dy = a.y_m - b.y_m;
  const float dz = a.z_m - b.z_m;
  return dx * dx + dy * dy + dz * dz;
}

}  // namespace

void RobotNeighbourhood::build(const Camera& camera, const RobotImage& robot) {
  columns_ = (camera.width_px + kTilePx - 1) / kTilePx;
  rows_ = (camera.height_px + kTilePx - 1) / kTilePx;
  ray_x_.resize(camera.width_px);
  ray_y_.resize(camera.height_px);
  for (int u = 0; u < camera.width_px; ++u)
    ray_x_[u] = static_cast<float>((u - camera.cx_px) / camera.fx_px);
  for (int v = 0; v < camera.height_px; ++v)
    ray_y_[v] = static_cast<float>((v - camera.cy_px) / camera.fy_px);
  points_.clear();
  tiles_.clear();
  groups_.clear();
  bounds_C_m_.setEmpty();
  for (int row = 0; row < rows_; row += kGroupTiles) {
    for (int column = 0; column < columns_; column += kGroupTiles) append_group(robot, column, row);
  }
}

void RobotNeighbourhood::append_group(const RobotImage& robot, int first_column, int first_row) {
  Group group{{}, static_cast<std::uint32_t>(tiles_.size()), 0};
  for (int row = first_row; row < std::min(rows_, first_row + kGroupTiles); ++row) {
    for (int column = first_column; column < std::min(columns_, first_column + kGroupTiles);
         ++column) {
      append_tile(robot, tile_pixels(column, row, robot.link_id.width(), robot.link_id.height()));
    }
  }
  group.tile_count = static_cast<std::uint32_t>(tiles_.size()) - group.first_tile;
  if (group.tile_count == 0) return;
  for (std::uint32_t i = 0; i < group.tile_count; ++i)
    group.box_C_m.extend(tiles_[group.first_tile + i].box_C_m);
  groups_.push_back(group);
  bounds_C_m_.extend(group.box_C_m);
}

void RobotNeighbourhood::append_tile(const RobotImage& robot, const PixelRect& pixels) {
  Tile tile{{}, static_cast<std::uint32_t>(points_.size()), 0};
  for (int v = pixels.v_begin; v < pixels.v_end; ++v) {
    for (int u = pixels.u_begin; u < pixels.u_end; ++u) {
      const LinkId id = robot.link_id(u, v);
      if (id == kNoLink || id == kEnvironmentLink) continue;
      const Point p = back_project(u, v, robot.depth_m(u, v));
      points_.push_back(p);
      tile.box_C_m.extend(Eigen::Vector3f(p.x_m, p.y_m, p.z_m));
    }
  }
  tile.point_count = static_cast<std::uint32_t>(points_.size()) - tile.first_point;
  if (tile.point_count == 0) return;
  tiles_.push_back(tile);
}

void RobotNeighbourhood::find_near(DepthView depth_m, const Image<PixelFate>& fate, double radius_m,
                                   Image<std::uint8_t>& near) {
  near.resize(depth_m.width, depth_m.height, 0);
  if (tiles_.empty()) return;
  witness_ = {kNowhere, kNowhere, kNowhere};
  const auto radius = static_cast<float>(radius_m);
  const float nearest_m = bounds_C_m_.min().z() - radius;
  const float farthest_m = bounds_C_m_.max().z() + radius;
  const auto may_be_near = [&](int u, int v) {
    return fate(u, v) == PixelFate::obstacle && depth_m(u, v) >= nearest_m &&
           depth_m(u, v) <= farthest_m;
  };
  for (int row = 0; row < rows_; ++row) {
    for (int column = 0; column < columns_; ++column) {
      const PixelRect pixels = tile_pixels(column, row, depth_m.width, depth_m.height);
      Eigen::AlignedBox3f box_C_m;
      for (int v = pixels.v_begin; v < pixels.v_end; ++v) {
        for (int u = pixels.u_begin; u < pixels.u_end; ++u) {
          if (!may_be_near(u, v)) continue;
          const Point p = back_project(u, v, depth_m(u, v));
          box_C_m.extend(Eigen::Vector3f(p.x_m, p.y_m, p.z_m));
        }
      }
      collect_tiles_near(box_C_m, radius);
      if (near_tiles_.empty()) continue;
      for (int v = pixels.v_begin; v < pixels.v_end; ++v) {
        for (int u = pixels.u_begin; u < pixels.u_end; ++u) {
          if (!may_be_near(u, v)) continue;
          near(u, v) = is_near(back_project(u, v, depth_m(u, v)), radius * radius) ? 1 : 0;
        }
      }
    }
  }
}

void RobotNeighbourhood::collect_tiles_near(const Eigen::AlignedBox3f& box_C_m, float radius_m) {
  near_tiles_.clear();
  const float radius2_m2 = radius_m * radius_m;
  if (box_C_m.isEmpty() || tiles_.empty() ||
      bounds_C_m_.squaredExteriorDistance(box_C_m) > radius2_m2)
    return;
  const auto may_be_near = [&](const Eigen::AlignedBox3f& box) {
    return box.squaredExteriorDistance(box_C_m) <= radius2_m2;
  };
  for (const Group& group : groups_) {
    if (!may_be_near(group.box_C_m)) continue;
    for (std::uint32_t i = group.first_tile; i < group.first_tile + group.tile_count; ++i) {
      if (may_be_near(tiles_[i].box_C_m)) near_tiles_.push_back(&tiles_[i]);
    }
  }
}

bool RobotNeighbourhood::is_near(const Point& p, float radius2_m2) {
  // Neighbouring pixels are near to the same point of the robot more often than not.
  if (squared_distance_m2(p, witness_) <= radius2_m2) return true;
  for (const Tile* tile : near_tiles_) {
    for (std::uint32_t i = tile->first_point; i < tile->first_point + tile->point_count; ++i) {
      if (squared_distance_m2(p, points_[i]) > radius2_m2) continue;
      witness_ = points_[i];
      return true;
    }
  }
  return false;
}

}  // namespace berth
