#include "berth/self_filter/grown_robot.hpp"

#include <algorithm>
#include <bit>
#include <limits>

#include "berth/self_filter/outline.hpp"

namespace berth {
namespace {

/// Keeps a pixel that is as far away as the radius itself.
constexpr double kRoundingMargin = 1 + 1e-9;

/// Pixels between two ranges; 0 if they share one.
int gap_px(int a_begin, int a_end, int b_begin, int b_end) {
  return std::max({0, a_begin - (b_end - 1), b_begin - (a_end - 1)});
}

int gap2_px2(const PixelRect& a, const PixelRect& b) {
  const int du = gap_px(a.u_begin, a.u_end, b.u_begin, b.u_end);
  const int dv = gap_px(a.v_begin, a.v_end, b.v_begin, b.v_end);
  return du * du + dv * dv;
}

PixelRect grown_by(const PixelRect& rect, int reach_px) {
  return {rect.u_begin - reach_px, rect.v_begin - reach_px, rect.u_end + reach_px,
          rect.v_end + reach_px};
}

/// What two rectangles share.
PixelRect shared(const PixelRect& a, const PixelRect& b) {
  return {std::max(a.u_begin, b.u_begin), std::max(a.v_begin, b.v_begin),
          std::min(a.u_end, b.u_end), std::min(a.v_end, b.v_end)};
}

}  // namespace

void GrownRobot::begin(const Camera& camera, const RobotImage& robot,
                       const SelfFilterSettings& settings, PixelFate grown) {
  camera_ = &camera;
  robot_ = &robot;
  settings_ = &settings;
  grown_ = grown;
  tolerance_ = tolerance_of(settings);
  grid_ = tiles_of(camera);
  robot_tiles_ = grid_.tiles_of(robot.extent);
  tiles_.resize(grid_.count());
  rows_.resize(grid_.rows());
  for (Row& row : rows_) row.reach_px = 0;
}

GrownRobot::Radius GrownRobot::radius_of(LinkId id, float depth_m) const {
  if (grown_ == PixelFate::dilation) {
    const double radius_px = settings_->dilation_px;
    return {radius_px, radius_px};
  }
  const bool is_island = grown_ == PixelFate::island;
  if (is_island && id == kEnvironmentLink) return {0, 0};
  const double padding_m = is_island ? settings_->island_radius_m : settings_->padding_of(id);
  const double longest_px = std::max(camera_->width_px, camera_->height_px);
  return {std::min(longest_px, padding_m * camera_->fx_px / depth_m),
          std::min(longest_px, padding_m * camera_->fy_px / depth_m)};
}

void GrownRobot::append_disc(int u, int v, Row& row, DiscTile& tile) const {
  const float depth_m = robot_->depth_m(u, v);
  const Radius radius = radius_of(robot_->link_id(u, v), depth_m);
  if (radius.u_px <= 0) return;
  const double ratio = radius.u_px / radius.v_px;
  const float least_m = tolerance_.least_reading_m(depth_m);
  const float most_m = depth_m + static_cast<float>(settings_->padding_depth_m);
  row.discs.push_back({static_cast<float>(u), static_cast<float>(v), least_m, most_m,
                       radius.u_px * radius.u_px * kRoundingMargin, ratio * ratio});
  ++tile.count;
  tile.bounds = united(tile.bounds, {u, v, u + 1, v + 1});
  // A pixel more than needed, against rounding.
  tile.reach_px =
      std::max(tile.reach_px, static_cast<float>(std::max(radius.u_px, radius.v_px)) + 1);
  tile.least_m = std::min(tile.least_m, least_m);
  tile.most_m = std::max(tile.most_m, most_m);
}

void GrownRobot::find_outline(int tile_row) {
  if (tile_row < robot_tiles_.v_begin || tile_row >= robot_tiles_.v_end) return;
  const auto pixel_rad = static_cast<float>(1 / std::max(camera_->fx_px, camera_->fy_px));
  Row& row = rows_[tile_row];
  row.discs.clear();
  for (int column = robot_tiles_.u_begin; column < robot_tiles_.u_end; ++column) {
    const PixelRect pixels = grid_.pixels(column, tile_row);
    DiscTile tile;
    tile.least_m = std::numeric_limits<float>::infinity();
    tile.first = static_cast<std::uint32_t>(row.discs.size());
    const TileBits outline = outline_of(*robot_, pixels, pixel_rad, tolerance_);
    for (int v = pixels.v_begin; v < pixels.v_end; ++v) {
      for (std::uint32_t bits = outline[v - pixels.v_begin]; bits != 0; bits &= bits - 1)
        append_disc(pixels.u_begin + std::countr_zero(bits), v, row, tile);
    }
    tiles_[grid_.index(column, tile_row)] = tile;
    row.reach_px = std::max(row.reach_px, tile.reach_px);
  }
}

void GrownRobot::end_outline() {
  reach_px_ = 0;
  for (const Row& row : rows_) reach_px_ = std::max(reach_px_, static_cast<int>(row.reach_px));
  const PixelRect extent = clip(robot_->extent, grid_.width_px, grid_.height_px);
  grown_tiles_ = reach_px_ == 0 ? PixelRect{} : grid_.tiles_of(grown_by(extent, reach_px_));
}

void GrownRobot::collect_near(const PixelRect& pixels, std::vector<NearDiscTile>& near) const {
  near.clear();
  const PixelRect tiles = shared(robot_tiles_, grid_.tiles_of(grown_by(pixels, reach_px_)));
  for (int r = tiles.v_begin; r < tiles.v_end; ++r) {
    for (int c = tiles.u_begin; c < tiles.u_end; ++c) {
      const DiscTile& tile = tiles_[grid_.index(c, r)];
      if (tile.count == 0) continue;
      const int distance2_px2 = gap2_px2(tile.bounds, pixels);
      if (static_cast<float>(distance2_px2) > tile.reach_px * tile.reach_px) continue;
      near.push_back({distance2_px2, &tile, rows_[r].discs.data() + tile.first});
    }
  }
  std::sort(near.begin(), near.end(), [](const NearDiscTile& a, const NearDiscTile& b) {
    return a.distance2_px2 < b.distance2_px2;
  });
}

void GrownRobot::grow(int tile_row, const GrownImages& images) {
  if (tile_row < grown_tiles_.v_begin || tile_row >= grown_tiles_.v_end) return;
  std::vector<NearDiscTile>& near = rows_[tile_row].near;
  for (int column = grown_tiles_.u_begin; column < grown_tiles_.u_end; ++column) {
    const PixelRect pixels = grid_.pixels(column, tile_row);
    if (!may_be_covered(pixels, images.fate)) continue;
    collect_near(pixels, near);
    if (near.empty()) continue;
    cover_with_discs(pixels, near, grown_, images);
  }
}

}  // namespace berth
