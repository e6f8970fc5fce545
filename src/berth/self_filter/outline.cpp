#include "berth/self_filter/outline.hpp"

#include <algorithm>

// Compiles the rest of this file once for each instruction set.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "berth/self_filter/outline.cpp"
#include "hwy/foreach_target.h"

#include "berth/self_filter/pixels-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace berth {
namespace HWY_NAMESPACE {

/// A row of the robot image, and those above and below: the row itself at the image's border.
struct OutlineRow {
  const float* depth_m[3];
  const LinkId* link_id[3];

  OutlineRow(const RobotImage& robot, int v) {
    for (int i = 0; i < 3; ++i) {
      const int n = std::clamp(v - 1 + i, 0, robot.depth_m.height() - 1);
      depth_m[i] = robot.depth_m.row(n);
      link_id[i] = robot.link_id.row(n);
    }
  }
};

/// `left` and `right` are the steps to the neighbours, 0 at the image's border.
template <class D>
HWY_INLINE std::uint64_t outline_bits(D d, const OutlineRow& row, int u, int left, int right,
                                      float deeper, const Tolerance& tolerance) {
  const auto z = hn::LoadU(d, row.depth_m[1] + u);
  const auto is_robot = hn::Eq(z, z);
  if (hn::AllFalse(d, is_robot)) return 0;
  const auto most = hn::Mul(z, hn::Set(d, deeper));
  const auto own_environment = hn::And(is_robot, is_environment(d, row.link_id[1] + u));
  const bool has_environment = !hn::AllFalse(d, own_environment);
  const bool has_links = !hn::AllFalse(d, hn::AndNot(own_environment, is_robot));
  const auto goes_on = [&](int i, int step) HWY_ATTR {
    const auto next_m = hn::LoadU(d, row.depth_m[i] + u + step);
    auto environment_goes_on = own_environment;
    if (has_environment)
      environment_goes_on = hn::And(own_environment, belongs_to(d, z, next_m, tolerance));
    if (!has_links) return environment_goes_on;
    const auto next_environment = is_environment(d, row.link_id[i] + u + step);
    const auto link_goes_on = hn::AndNot(next_environment, hn::Le(next_m, most));
    return hn::Or(environment_goes_on, hn::AndNot(own_environment, link_goes_on));
  };
  const auto goes_on_all_around =
      hn::And(hn::And(goes_on(1, left), goes_on(1, right)), hn::And(goes_on(0, 0), goes_on(2, 0)));
  return bits_of(d, hn::AndNot(goes_on_all_around, is_robot));
}

bool shows_robot(const RobotImage& robot, const PixelRect& tile) {
  bool found = false;
  for (int v = tile.v_begin; v < tile.v_end && !found; ++v) {
    for_pixels(tile.u_begin, tile.u_end, [&](auto d, int u) HWY_ATTR {
      const auto z = hn::LoadU(d, robot.depth_m.row(v) + u);
      found |= !hn::AllFalse(d, hn::Eq(z, z));
    });
  }
  return found;
}

TileBits outline_of_tile(const RobotImage& robot, const PixelRect& tile, float pixel_rad,
                         const Tolerance& tolerance) {
  TileBits bits{};
  if (!shows_robot(robot, tile)) return bits;
  const int last = robot.depth_m.width() - 1;
  // Whole vectors of pixels that have neighbours on both sides, some of them beside the tile.
  const int begin = std::clamp(tile.u_begin, 1, std::max(1, last - kTileWidth_px));
  const int end = std::min(last, begin + kTileWidth_px);
  const float deeper = 1 + pixel_rad;
  for (int v = tile.v_begin; v < tile.v_end; ++v) {
    const OutlineRow row(robot, v);
    std::uint64_t row_bits = 0;
    for_pixels(begin, end, [&](auto d, int u) HWY_ATTR {
      row_bits |= outline_bits(d, row, u, -1, 1, deeper, tolerance) << (u - begin);
    });
    row_bits = begin > tile.u_begin ? row_bits << 1 : row_bits >> (tile.u_begin - begin);
    if (tile.u_begin == 0)
      row_bits |= outline_bits(OneFloatTag(), row, 0, 0, last > 0, deeper, tolerance);
    if (tile.u_end == last + 1 && last > 0) {
      row_bits |= outline_bits(OneFloatTag(), row, last, -1, 0, deeper, tolerance)
                  << (last - tile.u_begin);
    }
    bits[v - tile.v_begin] = static_cast<std::uint16_t>(row_bits);
  }
  return bits;
}

}  // namespace HWY_NAMESPACE
}  // namespace berth
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace berth {

HWY_EXPORT(outline_of_tile);

void Outline::begin(const Camera& camera, const RobotImage& robot, const Tolerance& tolerance) {
  robot_ = &robot;
  tolerance_ = tolerance;
  pixel_rad_ = static_cast<float>(1 / std::max(camera.fx_px, camera.fy_px));
  grid_ = tiles_of(camera);
  robot_tiles_ = grid_.tiles_of(robot.extent);
  bits_.resize(grid_.count());
}

void Outline::find(int tile_row) {
  if (tile_row < robot_tiles_.v_begin || tile_row >= robot_tiles_.v_end) return;
  for (int column = robot_tiles_.u_begin; column < robot_tiles_.u_end; ++column) {
    bits_[grid_.index(column, tile_row)] = HWY_DYNAMIC_DISPATCH(outline_of_tile)(
        *robot_, grid_.pixels(column, tile_row), pixel_rad_, tolerance_);
  }
}

}  // namespace berth
#endif  // HWY_ONCE
