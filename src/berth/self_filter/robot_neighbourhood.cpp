#include "berth/self_filter/robot_neighbourhood.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <utility>

namespace berth {
namespace {

constexpr int kGroupSide = 4;
static_assert(kGroupSide * kGroupSide == kPackSize);

/// Where coordinates of low_m to high_m at positive depths within z appear along one axis of the
/// image: whole pixels and one more on both sides, clipped to what an image can have.
std::pair<int, int> projected_px(float low_m, float high_m, const DepthRange& z, double focal_px,
                                 double centre_px) {
  constexpr double kOutside_px = 1e6;
  const double low_px = std::min<double>(low_m / z.min_m, low_m / z.max_m) * focal_px + centre_px;
  const double high_px =
      std::max<double>(high_m / z.min_m, high_m / z.max_m) * focal_px + centre_px;
  return {static_cast<int>(std::clamp(std::floor(low_px) - 1, -kOutside_px, kOutside_px)),
          static_cast<int>(std::clamp(std::ceil(high_px) + 2, -kOutside_px, kOutside_px))};
}

}  // namespace

void RobotNeighbourhood::begin(const Camera& camera, const RobotImage& robot, double radius_m) {
  camera_ = &camera;
  robot_ = &robot;
  radius_m_ = static_cast<float>(radius_m);
  const TileGrid grid = tiles_of(camera);
  group_columns_ = (grid.columns() + kGroupSide - 1) / kGroupSide;
  const int group_rows = (grid.rows() + kGroupSide - 1) / kGroupSide;
  // A group at the border has boxes that nobody writes: they have to stay empty.
  if (grid != grid_) groups_.assign(static_cast<std::size_t>(group_columns_) * group_rows, {});
  grid_ = grid;
  rows_.resize(grid_.rows());
  ray_x_.resize(camera.width_px);
  ray_y_.resize(camera.height_px);
  for (int u = 0; u < camera.width_px; ++u)
    ray_x_[u] = static_cast<float>((u - camera.cx_px) / camera.fx_px);
  for (int v = 0; v < camera.height_px; ++v)
    ray_y_[v] = static_cast<float>((v - camera.cy_px) / camera.fy_px);
}

void RobotNeighbourhood::add_robot(int tile_row) {
  const PixelRect tiles = grid_.tiles_of(robot_->extent);
  const bool has_robot = tile_row >= tiles.v_begin && tile_row < tiles.v_end;
  const std::size_t first_group = static_cast<std::size_t>(tile_row / kGroupSide) * group_columns_;
  for (int column = 0; column < grid_.columns(); ++column) {
    BoxC box;
    if (has_robot && column >= tiles.u_begin && column < tiles.u_end)
      box = box_of_robot(surface(), grid_.pixels(column, tile_row));
    groups_[first_group + column / kGroupSide].set(
        tile_row % kGroupSide * kGroupSide + column % kGroupSide, box);
  }
}

PixelRect RobotNeighbourhood::pixels_of(std::size_t group, int i) const {
  const int column = static_cast<int>(group) % group_columns_ * kGroupSide + i % kGroupSide;
  const int row = static_cast<int>(group) / group_columns_ * kGroupSide + i / kGroupSide;
  return grid_.pixels(column, row);
}

void RobotNeighbourhood::end_robot() {
  packs_.clear();
  const PixelRect tiles = grid_.tiles_of(robot_->extent);
  std::size_t count = 0;
  for (int row = tiles.v_begin / kGroupSide; row * kGroupSide < tiles.v_end; ++row) {
    for (int column = tiles.u_begin / kGroupSide; column * kGroupSide < tiles.u_end; ++column) {
      const auto group = static_cast<std::size_t>(row) * group_columns_ + column;
      const BoxC box = box_of_boxes(groups_[group]);
      if (box.empty()) continue;
      if (count % kPackSize == 0) packs_.emplace_back();
      packs_.back().boxes.set(static_cast<int>(count % kPackSize), box);
      packs_.back().group[count % kPackSize] = group;
      ++count;
    }
  }
  set_range();
}

void RobotNeighbourhood::set_range() {
  bounds_ = {};
  for (const GroupPack& pack : packs_) bounds_ = united(bounds_, box_of_boxes(pack.boxes));
  range_ = {bounds_.min_m[2] - radius_m_, bounds_.max_m[2] + radius_m_};
  candidate_tiles_ = packs_.empty() ? PixelRect{} : candidate_tiles();
}

PixelRect RobotNeighbourhood::candidate_tiles() const {
  if (range_.min_m <= 0) return grid_.tiles_of(kEverywhere);
  const auto [u_begin, u_end] =
      projected_px(bounds_.min_m[0] - radius_m_, bounds_.max_m[0] + radius_m_, range_,
                   camera_->fx_px, camera_->cx_px);
  const auto [v_begin, v_end] =
      projected_px(bounds_.min_m[1] - radius_m_, bounds_.max_m[1] + radius_m_, range_,
                   camera_->fy_px, camera_->cy_px);
  return grid_.tiles_of({u_begin, v_begin, u_end, v_end});
}

void RobotNeighbourhood::find_near(int tile_row, DepthView sensor_depth_m,
                                   const Image<PixelFate>& fate, Image<std::uint8_t>& near) {
  Row& row = rows_[tile_row];
  row.near.clear();
  if (tile_row < candidate_tiles_.v_begin || tile_row >= candidate_tiles_.v_end) return;
  const CandidatePixels candidates{sensor_depth_m, fate, range_};
  for (int column = candidate_tiles_.u_begin; column < candidate_tiles_.u_end; ++column) {
    const PixelRect pixels = grid_.pixels(column, tile_row);
    if (find_near_in_tile(pixels, candidates, row.robot, near)) row.near.push_back(pixels);
  }
}

bool RobotNeighbourhood::find_near_in_tile(const PixelRect& pixels,
                                           const CandidatePixels& candidates,
                                           std::vector<RobotTile>& robot_tiles,
                                           Image<std::uint8_t>& near) const {
  const BoxC box = box_of_candidates(surface(), candidates, pixels);
  if (box.empty()) return false;
  const float radius2_m2 = radius_m_ * radius_m_;
  robot_tiles.clear();
  for (const GroupPack& pack : packs_) {
    std::uint32_t groups = near_boxes(box, pack.boxes, radius2_m2).some;
    for (; groups != 0; groups &= groups - 1) {
      const std::size_t group = pack.group[std::countr_zero(groups)];
      NearBits tiles = near_boxes(box, groups_[group], radius2_m2);
      if (tiles.all != 0) {
        mark_candidates(candidates, pixels, near);
        return true;
      }
      for (; tiles.some != 0; tiles.some &= tiles.some - 1) {
        const int i = std::countr_zero(tiles.some);
        robot_tiles.push_back({pixels_of(group, i), groups_[group].get(i)});
      }
    }
  }
  if (robot_tiles.empty()) return false;
  return mark_near(surface(), candidates, pixels, radius2_m2, robot_tiles, near);
}

}  // namespace berth
