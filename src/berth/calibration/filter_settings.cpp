#include "berth/calibration/filter_settings.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "berth/calibration/evidence_view.hpp"
#include "berth/calibration/swallowed.hpp"
#include "berth/fit/fit_rows.hpp"
#include "berth/fit/frame_drawer.hpp"
#include "berth/fit/robot_pixels.hpp"
#include "berth/self_filter/self_filter.hpp"

namespace berth {
namespace {

/// Added to what was seen, since other frames show more.
constexpr double kToleranceMargin_m = 0.005;
constexpr double kPaddingMargin_m = 0.01;
constexpr double kLeastTolerance_m = 0.02;
constexpr double kLeastPadding_m = 0.02;
constexpr double kOutlineReach_m = 0.08;
/// Two readings of one surface, at 1 m.
constexpr float kSameSurface_m = 0.03F;
/// More would drop what a finger shows at 1.5 m.
constexpr int kMostSpeckle_px = 40;
/// The number of frames that things are drawn into.
constexpr std::size_t kDrawnInto = 3;

double rounded_up(double length_m) { return std::ceil(length_m * 100 - 1e-6) / 100; }

/// One frame's images at the pose that was found.
struct ProposedCamera {
  DepthImage depth_m;
  RobotImage robot;
  std::vector<PosedSoftBody> soft;
  ObstacleImage filtered;
};

class Proposer {
 public:
  Proposer(const Camera& camera, const SelfFilterSettings& self_filter,
           const SensorSettings& sensor)
      : camera_(camera), self_filter_(self_filter), sensor_(sensor) {}

  void add_frame(const DepthImage& depth_m, const RobotImage& robot,
                 const std::vector<PosedSoftBody>& soft) {
    each_robot_pixel(camera_, robot, [&](int u, int v, LinkId) {
      const float behind_m = depth_m(u, v) - robot.depth_m(u, v);
      if (std::abs(behind_m) < kRobotLike_m) behind_m_.push_back(behind_m);
    });
    const int reach_px = static_cast<int>(camera_.fx_px * kOutlineReach_m);
    std::vector<FitRow> rows;
    append_outline_rows(camera_, depth_m, robot, CameraEstimate{}, 1, {reach_px, 0.05}, rows);
    for (const FitRow& row : rows) overshoot_m_.push_back(static_cast<float>(row.residual_m));
    views_.push_back({depth_m, robot, soft, {}});
  }

  FilterProposal run() {
    propose_lengths();
    propose_surface_tolerance();
    filter_all();
    count_leftovers();
    propose_speckle();
    draw_things();
    out_.self_filter_settings = self_filter_;
    out_.sensor_settings = sensor_;
    return std::move(out_);
  }

 private:
  void propose_lengths() {
    const double before_m = -quantile(behind_m_, 0.01);
    const double overshoot_m = quantile(overshoot_m_, 0.9);
    out_.bias_m = quantile(behind_m_, 0.5);
    if (!std::isnan(before_m)) {
      self_filter_.tolerance_m =
          rounded_up(std::max(kLeastTolerance_m, before_m + kToleranceMargin_m));
      out_.self_filter.push_back(
          {"tolerance_m", self_filter_.tolerance_m,
           fmt::format("99 % of the robot's readings lie at most {:.0f} mm in front of the model",
                       std::max(0.0, 1000 * before_m))});
    }
    if (!std::isnan(overshoot_m)) {
      self_filter_.padding_m =
          rounded_up(std::max(kLeastPadding_m, overshoot_m + kPaddingMargin_m));
      out_.self_filter.push_back(
          {"padding_m", self_filter_.padding_m,
           fmt::format("at nine of ten places of its outline the camera sees the robot at most "
                       "{:.0f} mm wider than the model",
                       std::max(0.0, 1000 * overshoot_m))});
    }
  }

  /// That of the image whose readings scatter most.
  void propose_surface_tolerance() {
    double greatest_m = 0;
    for (const ProposedCamera& view : views_) {
      const SurfaceTolerance found = measured_surface_tolerance(camera_, view.depth_m, view.robot);
      greatest_m = std::max<double>(greatest_m, found.links_m);
    }
    if (views_.empty()) return;
    self_filter_.surface_tolerance_m = std::ceil(greatest_m * 1000 - 1e-6) / 1000;
    out_.self_filter.push_back(
        {"surface_tolerance_m", *self_filter_.surface_tolerance_m,
         fmt::format("98 % of the robot's readings lie within {:.0f} mm of its surface at 1 m",
                     1000 * greatest_m)});
  }

  void filter_all() {
    SelfFilterWorkspace workspace;
    SelfFilterSettings settings = self_filter_;
    settings.robot_region_scale = 0;
    for (ProposedCamera& view : views_) {
      self_filter(camera_, view.depth_m, view.robot, settings, workspace, view.filtered);
      drop_soft(camera_, view.soft, view.filtered);
    }
  }

  /// Whether another frame shows the same surface there.
  bool is_fixed(std::size_t frame, int u, int v) const {
    const float z_m = views_[frame].depth_m(u, v);
    for (std::size_t other = 0; other < views_.size(); ++other) {
      if (other == frame || !is_kept(views_[other].filtered.fate(u, v))) continue;
      const float off_m = std::abs(views_[other].depth_m(u, v) - z_m);
      if (off_m < kSameSurface_m * std::max(1.0F, z_m * z_m)) return true;
    }
    return false;
  }

  /// Whether the robot is within 10 cm, in the image and in depth.
  bool is_near_robot(const ProposedCamera& view, int u, int v) const {
    const float z_m = view.depth_m(u, v);
    const int reach_px = static_cast<int>(camera_.fx_px * kRobotLike_m / z_m);
    const PixelRect near = clip({u - reach_px, v - reach_px, u + reach_px + 1, v + reach_px + 1},
                                camera_.width_px, camera_.height_px);
    for (int b = near.v_begin; b < near.v_end; b += 3) {
      for (int a = near.u_begin; a < near.u_end; a += 3) {
        if (!is_robot(view.robot.link_id(a, b))) continue;
        if (std::abs(view.robot.depth_m(a, b) - z_m) < kRobotLike_m) return true;
      }
    }
    return false;
  }

  void count_leftovers() {
    // One frame alone cannot tell what is fixed.
    if (views_.size() < 2) return;
    for (std::size_t f = 0; f < views_.size(); ++f) {
      Image<std::uint8_t> left(camera_.width_px, camera_.height_px, 0);
      for (int v = 0; v < camera_.height_px; ++v) {
        for (int u = 0; u < camera_.width_px; ++u) {
          if (!is_kept(views_[f].filtered.fate(u, v)) || is_fixed(f, u, v)) continue;
          if (!is_near_robot(views_[f], u, v)) continue;
          left(u, v) = 1;
          ++out_.leftover_px;
        }
      }
      out_.largest_leftover_px = std::max(out_.largest_leftover_px, largest_blob(left));
    }
  }

  /// Joined by their eight neighbours. Empties the image.
  int largest_blob(Image<std::uint8_t>& left) const {
    int largest = 0;
    std::vector<Pixel> open;
    for (int v = 0; v < left.height(); ++v) {
      for (int u = 0; u < left.width(); ++u) {
        if (!left(u, v)) continue;
        int size = 0;
        left(u, v) = 0;
        open.push_back({u, v});
        while (!open.empty()) {
          const Pixel at = open.back();
          open.pop_back();
          ++size;
          const PixelRect near =
              clip({at.u - 1, at.v - 1, at.u + 2, at.v + 2}, left.width(), left.height());
          for (int b = near.v_begin; b < near.v_end; ++b) {
            for (int a = near.u_begin; a < near.u_end; ++a) {
              if (!left(a, b)) continue;
              left(a, b) = 0;
              open.push_back({a, b});
            }
          }
        }
        largest = std::max(largest, size);
      }
    }
    return largest;
  }

  void propose_speckle() {
    if (out_.largest_leftover_px == 0 || out_.largest_leftover_px >= kMostSpeckle_px) return;
    const int speckle_px = std::max(sensor_.speckle_px, out_.largest_leftover_px + 1);
    if (speckle_px == sensor_.speckle_px) return;
    sensor_.speckle_px = speckle_px;
    out_.sensor.push_back({"speckle_px", static_cast<double>(speckle_px),
                           fmt::format("what is left near the robot are blobs of at most {} pixels",
                                       out_.largest_leftover_px)});
  }

  void draw_things() {
    std::vector<FilteredCamera> views;
    const std::size_t step = std::max<std::size_t>(1, views_.size() / kDrawnInto);
    for (std::size_t f = 0; f < views_.size() && views.size() < kDrawnInto; f += step) {
      const ProposedCamera& view = views_[f];
      views.push_back({&camera_, view.depth_m, &view.robot, &self_filter_, &sensor_, &view.soft});
    }
    for (const double depth_m : {1.0, 1.5, 2.0}) {
      out_.smallest.push_back(smallest_obstacle(views, depth_m));
    }
    out_.rod_gap_m = least_rod_gap_m(views);
  }

  const Camera& camera_;
  SelfFilterSettings self_filter_;
  SensorSettings sensor_;
  std::vector<ProposedCamera> views_;
  std::vector<float> behind_m_;
  std::vector<float> overshoot_m_;
  FilterProposal out_;
};

}  // namespace

FilterProposal propose_filter(const CalibrationData& calibration_data, std::size_t camera_index,
                              const CalibrationResult& found, bool corrects_depth,
                              const SelfFilterSettings& self_filter, const SensorSettings& sensor) {
  CalibrationData one = calibration_data;
  one.cameras = {calibration_data.cameras[camera_index]};
  const CameraCalibration& camera = found.cameras[camera_index];
  std::vector<RobotImage> robots(one.cameras[0]->frames.size());
  std::vector<std::vector<PosedSoftBody>> soft(robots.size());
  FrameDrawer(one, {1}).draw(
      1, found_estimate(one, camera, found), {}, FrameChoice::all, [&](const DrawnFrame& drawn) {
        robots[drawn.frame_index] = drawn.robot;
        pose_soft_bodies(*one.model, drawn.posed.pose, drawn.posed.X_BC, soft[drawn.frame_index]);
      });
  Proposer proposer(one.cameras[0]->camera, self_filter, sensor);
  for (std::size_t f = 0; f < robots.size(); ++f) {
    // Its joints are not known at the clock that was found.
    if (robots[f].depth_m.pixels().empty()) continue;
    const DepthImage& depth_m = one.cameras[0]->frames[f].depth_m;
    proposer.add_frame(corrects_depth ? corrected(depth_m, camera.depth) : depth_m, robots[f],
                       soft[f]);
  }
  return proposer.run();
}

}  // namespace berth
