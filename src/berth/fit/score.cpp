#include "berth/fit/score.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "berth/fit/fit_rows.hpp"
#include "berth/fit/robot_pixels.hpp"

namespace berth {
namespace {

constexpr double kSeenThrough = -1;
constexpr double kHidden = -0.25;
/// Readings that are like the robot, for outlines.
constexpr double kBand_m = 0.05;
constexpr double kNoRobot = -2;

struct Sum {
  double depth = 0;
  double pixels = 0;
  double outline = 0;
  double places = 0;

  Sum& operator+=(const Sum& other) {
    depth += other.depth;
    pixels += other.pixels;
    outline += other.outline;
    places += other.places;
    return *this;
  }
};

/// 1 at 0, 0 at the cut.
double fit_of(double residual_m, double cut_m) {
  const double ratio = residual_m / cut_m;
  return std::max(0.0, 1 - ratio * ratio);
}

void add_depth(const DrawnFrame& drawn, const CameraEstimate& estimate, double cut_m, Sum& sum) {
  const int stride = drawn.step == 1 ? 2 : 1;
  const auto add = [&](int u, int v, LinkId) {
    const double behind_m = estimate.corrected(drawn.depth_m(u, v)) - drawn.robot.depth_m(u, v);
    if (std::isnan(behind_m)) return;
    sum.pixels += 1;
    sum.depth += behind_m > cut_m    ? kSeenThrough
                 : behind_m < -cut_m ? kHidden
                                     : fit_of(behind_m, cut_m);
  };
  each_robot_pixel(drawn.camera, drawn.robot, add, stride);
}

void add_outline(const DrawnFrame& drawn, const CameraEstimate& estimate,
                 const ScoreSettings& settings, Sum& sum) {
  std::vector<FitRow> rows;
  const int reach = std::max(2, settings.outline_reach_px / drawn.step);
  const OutlineCount count = append_outline_rows(drawn.camera, drawn.depth_m, drawn.robot, estimate,
                                                 drawn.step, {reach, kBand_m}, rows);
  sum.places += count.places;
  for (const FitRow& row : rows) {
    const double reach_m = (reach + 1) * row.p_C_m.z() / drawn.camera.fx_px;
    sum.outline += fit_of(row.residual_m, reach_m);
  }
}

}  // namespace

Score score(FrameDrawer& drawer, const CalibrationEstimate& estimate, const ScoreSettings& settings,
            FrameChoice choice) {
  const CalibrationData& calibration_data = drawer.calibration_data();
  std::vector<std::vector<Sum>> parts(calibration_data.cameras.size());
  for (std::size_t c = 0; c < parts.size(); ++c)
    parts[c].resize(calibration_data.cameras[c]->frames.size());
  drawer.draw(settings.step, estimate, {}, choice, [&](const DrawnFrame& drawn) {
    Sum& sum = parts[drawn.camera_index][drawn.frame_index];
    const CameraEstimate& camera = estimate.cameras[drawn.camera_index];
    add_depth(drawn, camera, settings.cut_m, sum);
    if (settings.outline_reach_px > 0) add_outline(drawn, camera, settings, sum);
  });
  Sum sum;
  for (const auto& camera : parts) {
    for (const Sum& part : camera) sum += part;
  }
  if (sum.pixels == 0) return {kNoRobot, 0, 0};
  const double places = std::max(sum.places, settings.least_places);
  return {sum.depth / std::max(sum.pixels, settings.least_pixels) +
              (places > 0 ? sum.outline / places : 0),
          sum.pixels, sum.places};
}

}  // namespace berth
