#include "berth/calibration/moved_environment.hpp"

#include <cmath>

#include "berth/calibration/evidence_view.hpp"
#include "berth/fit/frame_drawer.hpp"

namespace berth {
namespace {

/// Of the sensor's image: what moves is large.
constexpr int kStep = 4;
constexpr double kBeside_m = 0.10;
constexpr float kOther_m = 0.10F;

/// The readings that lie well beside the robot in the image.
DepthImage beside_robot(const DrawnFrame& drawn) {
  DepthImage out(drawn.camera.width_px, drawn.camera.height_px, kNoDepth);
  for (int v = 0; v < out.height(); ++v) {
    for (int u = 0; u < out.width(); ++u) out(u, v) = drawn.depth_m(u, v);
  }
  const PixelRect extent = clip(drawn.robot.extent, out.width(), out.height());
  for (int v = extent.v_begin; v < extent.v_end; ++v) {
    for (int u = extent.u_begin; u < extent.u_end; ++u) {
      if (drawn.robot.link_id(u, v) == kNoLink) continue;
      const int reach_px =
          static_cast<int>(std::ceil(drawn.camera.fx_px * kBeside_m / drawn.robot.depth_m(u, v)));
      const PixelRect near = clip({u - reach_px, v - reach_px, u + reach_px + 1, v + reach_px + 1},
                                  out.width(), out.height());
      for (int b = near.v_begin; b < near.v_end; ++b) {
        std::fill(out.row(b) + near.u_begin, out.row(b) + near.u_end, kNoDepth);
      }
    }
  }
  return out;
}

double changed_share(const DepthImage& a, const DepthImage& b) {
  double both = 0;
  double changed = 0;
  for (std::size_t i = 0; i < a.pixels().size(); ++i) {
    const float z_m = a.pixels()[i];
    const float off_m = std::abs(b.pixels()[i] - z_m);
    if (std::isnan(off_m)) continue;
    both += 1;
    changed += off_m > kOther_m * std::max(1.0F, z_m * z_m);
  }
  return both > 0 ? changed / both : 0;
}

}  // namespace

std::vector<EnvironmentChange> moved_environment(const CalibrationData& calibration_data,
                                                 const CalibrationResult& found) {
  std::vector<EnvironmentChange> changes;
  for (std::size_t c = 0; c < calibration_data.cameras.size(); ++c) {
    CalibrationData one = calibration_data;
    one.cameras = {calibration_data.cameras[c]};
    if (calibration_data.model->is_moved(one.cameras[0]->parent)) continue;
    const std::vector<CalibrationFrame>& frames = one.cameras[0]->frames;
    std::vector<DepthImage> beside(frames.size());
    FrameDrawer(one, {kStep})
        .draw(kStep, found_estimate(one, found.cameras[c], found), {}, FrameChoice::all,
              [&](const DrawnFrame& drawn) { beside[drawn.frame_index] = beside_robot(drawn); });
    for (std::size_t f = 0; f + 1 < frames.size(); ++f) {
      if (beside[f].pixels().size() != beside[f + 1].pixels().size()) continue;
      const double share = changed_share(beside[f], beside[f + 1]);
      if (share <= kMostChanged) continue;
      changes.push_back({one.cameras[0]->name, frames[f].number, frames[f + 1].number, share});
    }
  }
  return changes;
}

}  // namespace berth
