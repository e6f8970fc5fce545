#include "berth/reports/calibration_coverage.hpp"

#include <algorithm>
#include <cmath>

#include "berth/fit/robot_pixels.hpp"
#include "berth/scene/calibrated_robot.hpp"

namespace berth {
namespace {

constexpr int kLeastLink_px = 100;
constexpr double kOutermost = 0.02;

CoveredRange range_of(std::vector<float>& values) {
  return {quantile(values, kOutermost), quantile(values, 1 - kOutermost)};
}

/// Of every reading of the robot in all frames.
struct Readings {
  std::vector<float> across;
  std::vector<float> down;
  std::vector<float> depth_m;
};

FrameCoverage look_at(const DepthImage& depth_m, const RobotImage& robot,
                      const DepthImage& residual_m, Readings& readings, std::vector<int>& link_px) {
  FrameCoverage frame;
  std::vector<float> off_m;
  for (int v = 0; v < depth_m.height(); ++v) {
    for (int u = 0; u < depth_m.width(); ++u) {
      const LinkId id = robot.link_id(u, v);
      if (!is_robot(id)) continue;
      ++frame.robot_px;
      if (std::isnan(residual_m(u, v))) continue;
      ++frame.reading_px;
      if (!(std::abs(residual_m(u, v)) < kRobotLike_m)) continue;
      ++link_px[id - 1];
      off_m.push_back(std::abs(residual_m(u, v)));
      readings.across.push_back((static_cast<float>(u) + 0.5F) /
                                static_cast<float>(depth_m.width()));
      readings.down.push_back((static_cast<float>(v) + 0.5F) /
                              static_cast<float>(depth_m.height()));
      readings.depth_m.push_back(depth_m(u, v));
    }
  }
  frame.fitting_px = static_cast<int>(off_m.size());
  frame.median_residual_m = quantile(off_m, 0.5);
  return frame;
}

std::vector<double> joint_ranges(const CalibrationCamera& camera, std::size_t joints) {
  std::vector<double> ranges(joints, 0.0);
  for (std::size_t j = 0; j < joints && !camera.frames.empty(); ++j) {
    const auto [least, most] =
        std::minmax_element(camera.frames.begin(), camera.frames.end(),
                            [j](const CalibrationFrame& a, const CalibrationFrame& b) {
                              return a.joints.position[j] < b.joints.position[j];
                            });
    ranges[j] = most->joints.position[j] - least->joints.position[j];
  }
  return ranges;
}

}  // namespace

CalibrationCoverage coverage_of(const CalibrationReport& report, std::size_t camera) {
  const RobotModel& model = *report.calibration_data->model;
  CalibratedRobot calibrated(*report.calibration_data, *report.result, camera);
  CalibrationCoverage coverage;
  coverage.frames_with_link.assign(model.evaluated_links.size(), 0);
  coverage.joint_range = joint_ranges(calibrated.source(), model.joints.size());
  Readings readings;
  for (std::size_t k = 0; k < calibrated.source().frames.size(); ++k) {
    const RobotImage* robot = calibrated.draw(k, CalibrationSide::after);
    if (!robot) continue;
    std::vector<int> link_px(model.evaluated_links.size(), 0);
    const CalibrationFrame& frame = calibrated.source().frames[k];
    FrameCoverage& seen = coverage.frames.emplace_back(
        look_at(frame.depth_m, *robot, calibrated.residual_m(k, CalibrationSide::after, *robot),
                readings, link_px));
    seen.number = frame.number;
    for (std::size_t i = 0; i < link_px.size(); ++i) {
      if (link_px[i] >= kLeastLink_px) ++coverage.frames_with_link[i];
    }
  }
  coverage.across = range_of(readings.across);
  coverage.down = range_of(readings.down);
  coverage.depth_m = range_of(readings.depth_m);
  coverage.median_depth_m = quantile(readings.depth_m, 0.5);
  return coverage;
}

}  // namespace berth
