#include "berth/self_filter/self_filter.hpp"

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <stdexcept>

#include "berth/self_filter/rows.hpp"
#include "berth/self_filter/tiles.hpp"
#include "berth/types/obstacle_image.hpp"
#include "berth/types/robot_image.hpp"

namespace berth {

void validate(const SelfFilterSettings& settings) {
  const SettingCheck check{"self_filter"};
  visit_settings(settings, check);
  check({"robot_region_scale", {.least = 1, .has_off = true}, ""}, settings.robot_region_scale);
  for (const double padding_m : settings.link_padding_m) {
    if (!std::isnan(padding_m)) check({"link_padding_m", kNotNegative, ""}, padding_m);
  }
}

void require_region(const SelfFilterSettings& settings, bool is_given) {
  if (is_given == (settings.robot_region_scale > 0)) return;
  throw std::invalid_argument(
      fmt::format("self_filter.robot_region_scale: {}; expected {}", settings.robot_region_scale,
                  is_given ? "the scale of the region that is given" : "0 without a region"));
}

namespace {

/// Gives the obstacles where `region` shows nothing the fate `outside_region`.
void ignore_outside(const RobotImage& region, ObstacleImage& out) {
  assert(region.link_id.width() == out.fate.width() &&
         region.link_id.height() == out.fate.height());
  std::int64_t ignored = 0;
  for (int v = 0; v < out.fate.height(); ++v) {
    const LinkId* const id = region.link_id.row(v);
    PixelFate* const fate = out.fate.row(v);
    float* const depth_m = out.depth_m.row(v);
    for (int u = 0; u < out.fate.width(); ++u) {
      const bool is_ignored = fate[u] == PixelFate::obstacle && id[u] == kNoLink;
      fate[u] = is_ignored ? PixelFate::outside_region : fate[u];
      depth_m[u] = is_ignored ? kNoDepth : depth_m[u];
      ignored += is_ignored;
    }
  }
  out.count[static_cast<std::size_t>(PixelFate::obstacle)] -= ignored;
  out.count[static_cast<std::size_t>(PixelFate::outside_region)] += ignored;
}

/// New pixels only for a new size.
template <class T>
void set_size(const Camera& camera, Image<T>& image) {
  if (image.width() == camera.width_px && image.height() == camera.height_px) return;
  image.resize(camera.width_px, camera.height_px, T{});
}

/// Whose outline the workspace has.
void judge_pieces_of_outline(const Camera& camera, DepthView sensor_depth_m,
                             const RobotImage& robot, const SelfFilterSettings& settings,
                             SelfFilterWorkspace& workspace, ObstacleImage& out) {
  find_surface_things(camera, sensor_depth_m, robot, settings, workspace.surface_things, out);
  if (!(settings.flying_patch_radius_m > 0)) return;
  workspace.flying_patches.neighbourhood.begin(camera, robot, settings, workspace.outline);
  set_size(camera, workspace.flying_patches.state);
  judge_flying_patches(camera, sensor_depth_m, robot, tolerance_of(settings),
                       workspace.surface_things.things, workspace.flying_patches, out);
}

/// One image's way through the rules for pixels. Between two rounds over the rows of tiles all
/// threads meet: growth and neighbourhood need the robot of other rows.
class Filter {
 public:
  Filter(const Camera& camera, DepthView sensor_depth_m, const RobotImage& robot,
         const SelfFilterSettings& settings, SelfFilterWorkspace& workspace, ObstacleImage& out)
      : grid_(tiles_of(camera)),
        sensor_depth_m_(sensor_depth_m),
        robot_(robot),
        extent_(grid_.pixels(grid_.tiles_of(robot.extent))),
        settings_(settings),
        tolerance_(tolerance_of(settings)),
        workspace_(workspace),
        out_(out) {
    workspace.outline.begin(camera, robot, tolerance_);
    workspace.padding.begin(camera, robot, settings, workspace.outline, PixelFate::padding);
  }

  void run() {
    workspace_.counts.resize(grid_.rows());
    tbb::parallel_for(0, grid_.rows(), [this](int tile_row) { look_at_pixels(tile_row); });
    workspace_.padding.end_discs();
    tbb::parallel_for(0, grid_.rows(), [this](int tile_row) { look_around(tile_row); });
    add_counts();
  }

 private:
  int v_begin(int tile_row) const { return tile_row * kTileHeight_px; }
  int v_end(int tile_row) const { return std::min(grid_.height_px, v_begin(tile_row + 1)); }

  void look_at_pixels(int tile_row) {
    for (int v = v_begin(tile_row); v < v_end(tile_row); ++v) {
      const FilterRow row{sensor_depth_m_.row(v), robot_.depth_m.row(v), robot_.link_id.row(v),
                          out_.fate.row(v), out_.depth_m.row(v)};
      classify(v, row);
    }
    workspace_.outline.find(tile_row);
    workspace_.padding.make_discs(tile_row);
  }

  void classify(int v, const FilterRow& row) {
    if (v < extent_.v_begin || v >= extent_.v_end) {
      copy_row(row, 0, grid_.width_px);
      return;
    }
    copy_row(row, 0, extent_.u_begin);
    classify_row(row, extent_.u_begin, extent_.u_end, tolerance_);
    copy_row(row, extent_.u_end, grid_.width_px);
  }

  void look_around(int tile_row) {
    workspace_.padding.grow(tile_row, sensor_depth_m_, out_);
    auto& count = workspace_.counts[tile_row];
    count.fill(0);
    for (int v = v_begin(tile_row); v < v_end(tile_row); ++v)
      count_fates(out_.fate.row(v), grid_.width_px, count);
  }

  void add_counts() {
    out_.count.fill(0);
    for (const auto& count : workspace_.counts) {
      for (int fate = 0; fate < kPixelFateCount; ++fate) out_.count[fate] += count[fate];
    }
  }

  TileGrid grid_;
  DepthView sensor_depth_m_;
  const RobotImage& robot_;
  /// Of the tiles that may show the robot.
  PixelRect extent_;
  const SelfFilterSettings& settings_;
  Tolerance tolerance_;
  SelfFilterWorkspace& workspace_;
  ObstacleImage& out_;
};

void filter(const Camera& camera, DepthView sensor_depth_m, const RobotImage& robot,
            const SelfFilterSettings& settings, SelfFilterWorkspace& workspace,
            ObstacleImage& out) {
  assert(sensor_depth_m.width == camera.width_px && sensor_depth_m.height == camera.height_px);
  assert(robot.link_id.width() == camera.width_px && robot.link_id.height() == camera.height_px);
  set_size(camera, out.depth_m);
  set_size(camera, out.fate);
  Filter(camera, sensor_depth_m, robot, settings, workspace, out).run();
  judge_pieces_of_outline(camera, sensor_depth_m, robot, settings, workspace, out);
}

}  // namespace

void self_filter(const Camera& camera, DepthView sensor_depth_m, const RobotImage& robot,
                 const SelfFilterSettings& settings, SelfFilterWorkspace& workspace,
                 ObstacleImage& out) {
  require_region(settings, false);
  filter(camera, sensor_depth_m, robot, settings, workspace, out);
}

void self_filter(const Camera& camera, DepthView sensor_depth_m, const RobotImage& robot,
                 const RobotImage& region, const SelfFilterSettings& settings,
                 SelfFilterWorkspace& workspace, ObstacleImage& out) {
  require_region(settings, true);
  filter(camera, sensor_depth_m, robot, settings, workspace, out);
  ignore_outside(region, out);
}

void judge_pieces(const Camera& camera, DepthView sensor_depth_m, const RobotImage& robot,
                  const SelfFilterSettings& settings, SelfFilterWorkspace& workspace,
                  ObstacleImage& out) {
  workspace.outline.begin(camera, robot, tolerance_of(settings));
  for (int row = 0; row < tiles_of(camera).rows(); ++row) workspace.outline.find(row);
  judge_pieces_of_outline(camera, sensor_depth_m, robot, settings, workspace, out);
}

}  // namespace berth
