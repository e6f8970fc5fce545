#include "berth/self_filter/grown_robot.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

#include "berth/types/image.hpp"

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

/// What two rectangles share.
PixelRect shared(const PixelRect& a, const PixelRect& b) {
  return {std::max(a.u_begin, b.u_begin), std::max(a.v_begin, b.v_begin),
          std::min(a.u_end, b.u_end), std::min(a.v_end, b.v_end)};
}

/// Around the bits.
PixelRect bounds_of(const TileBits& bits, const PixelRect& tile) {
  PixelRect bounds;
  unsigned columns = 0;
  for (int v = tile.v_begin; v < tile.v_end; ++v) {
    const unsigned row = bits[v - tile.v_begin];
    if (row == 0) continue;
    if (columns == 0) bounds.v_begin = v;
    bounds.v_end = v + 1;
    columns |= row;
  }
  bounds.u_begin = tile.u_begin + std::countr_zero(columns);
  bounds.u_end = tile.u_begin + std::bit_width(columns);
  return bounds;
}

}  // namespace

void GrownRobot::begin(const Camera& camera, const RobotImage& robot,
                       const SelfFilterSettings& settings, const Outline& outline,
                       PixelFate grown) {
  camera_ = &camera;
  robot_ = &robot;
  settings_ = &settings;
  outline_ = &outline;
  grown_ = grown;
  tolerance_ = tolerance_of(settings);
  grid_ = tiles_of(camera);
  tiles_.resize(grid_.count());
  rows_.resize(grid_.rows());
}

GrownRobot::Radius GrownRobot::radius_of(LinkId id, float depth_m) const {
  const bool is_flying_patch = grown_ == PixelFate::flying_patch;
  if (is_flying_patch && id == kEnvironmentLink) return {0, 0};
  const double padding_m =
      is_flying_patch ? settings_->flying_patch_radius_m : settings_->padding_of(id);
  const double longest_px = std::max(camera_->width_px, camera_->height_px);
  return {std::min(longest_px, padding_m * camera_->fx_px / depth_m),
          std::min(longest_px, padding_m * camera_->fy_px / depth_m)};
}

DiscTile GrownRobot::append_discs(const TileBits& outline, const PixelRect& pixels,
                                  std::vector<Disc>& discs) const {
  DiscTile tile;
  tile.bounds = bounds_of(outline, pixels);
  tile.first = static_cast<std::uint32_t>(discs.size());
  const auto depth_behind_m = static_cast<float>(settings_->padding_depth_m);
  float least_m = std::numeric_limits<float>::infinity();
  float most_m = 0;
  double longest_px = 0;
  for_bits(outline, pixels, [&](int u, int v) {
    const float depth_m = robot_->depth_m(u, v);
    const Radius radius = radius_of(robot_->link_id(u, v), depth_m);
    if (radius.u_px <= 0) return;
    const double ratio = radius.u_px / radius.v_px;
    const Disc disc{static_cast<float>(u),
                    static_cast<float>(v),
                    tolerance_.least_reading_m(depth_m),
                    depth_m + depth_behind_m,
                    radius.u_px * radius.u_px * kRoundingMargin,
                    ratio * ratio};
    discs.push_back(disc);
    least_m = std::min(least_m, disc.least_m);
    most_m = std::max(most_m, disc.most_m);
    longest_px = std::max(longest_px, std::max(radius.u_px, radius.v_px));
  });
  tile.count = static_cast<std::uint32_t>(discs.size()) - tile.first;
  tile.least_m = least_m;
  tile.most_m = most_m;
  tile.reach2_px2 = static_cast<int>(longest_px * longest_px * kRoundingMargin * kRoundingMargin);
  tile.reach_px = static_cast<int>(std::sqrt(tile.reach2_px2));
  return tile;
}

void GrownRobot::make_discs(int tile_row) {
  const PixelRect& tiles = outline_->tiles();
  if (tile_row < tiles.v_begin || tile_row >= tiles.v_end) return;
  Row& row = rows_[tile_row];
  row.discs.clear();
  for (int column = tiles.u_begin; column < tiles.u_end; ++column) {
    DiscTile& tile = tiles_[grid_.index(column, tile_row)];
    tile = append_discs(outline_->in_tile(column, tile_row), grid_.pixels(column, tile_row),
                        row.discs);
  }
}

void GrownRobot::end_discs() {
  reach_px_ = -1;
  is_reached_.assign(grid_.count(), 0);
  const PixelRect& tiles = outline_->tiles();
  for (int row = tiles.v_begin; row < tiles.v_end; ++row) {
    for (int column = tiles.u_begin; column < tiles.u_end; ++column) {
      const DiscTile& tile = tiles_[grid_.index(column, row)];
      if (tile.count > 0) reach_from(tile);
    }
  }
}

void GrownRobot::reach_from(const DiscTile& tile) {
  reach_px_ = std::max(reach_px_, tile.reach_px);
  const PixelRect reached = grid_.tiles_of(grown_by(tile.bounds, tile.reach_px));
  for (int row = reached.v_begin; row < reached.v_end; ++row) {
    const auto first = is_reached_.begin() + static_cast<std::ptrdiff_t>(grid_.index(0, row));
    std::fill(first + reached.u_begin, first + reached.u_end, 1);
  }
}

void GrownRobot::collect_near(const PixelRect& pixels, std::vector<NearDiscTile>& near) const {
  near.clear();
  const PixelRect tiles = shared(outline_->tiles(), grid_.tiles_of(grown_by(pixels, reach_px_)));
  for (int r = tiles.v_begin; r < tiles.v_end; ++r) {
    for (int c = tiles.u_begin; c < tiles.u_end; ++c) {
      const DiscTile& tile = tiles_[grid_.index(c, r)];
      if (tile.count == 0) continue;
      const int distance2_px2 = gap2_px2(tile.bounds, pixels);
      if (distance2_px2 > tile.reach2_px2) continue;
      near.push_back({distance2_px2, &tile, rows_[r].discs.data() + tile.first});
    }
  }
  std::sort(near.begin(), near.end(), [](const NearDiscTile& a, const NearDiscTile& b) {
    return a.distance2_px2 < b.distance2_px2;
  });
}

TileBits GrownRobot::covered(int column, int tile_row, DepthView sensor_depth_m,
                             const Image<PixelFate>& fate) {
  const PixelRect pixels = grid_.pixels(column, tile_row);
  if (is_reached_[grid_.index(column, tile_row)] == 0 || !may_be_covered(pixels, fate)) return {};
  std::vector<NearDiscTile>& near = rows_[tile_row].near;
  collect_near(pixels, near);
  return near.empty() ? TileBits{} : covered_by_discs(pixels, near, sensor_depth_m, fate);
}

void GrownRobot::grow(int tile_row, DepthView sensor_depth_m, ObstacleImage& out) {
  for (int column = 0; column < grid_.columns(); ++column) {
    for_bits(covered(column, tile_row, sensor_depth_m, out.fate), grid_.pixels(column, tile_row),
             [&](int u, int v) {
               out.fate(u, v) = grown_;
               out.depth_m(u, v) = kNoDepth;
             });
  }
}

}  // namespace berth
