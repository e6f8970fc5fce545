#include "lab/calibration/drawn.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "berth/calibration/calibrate.hpp"
#include "lab/calibration/robot_points.hpp"
#include "lab/measure/stopwatch.hpp"
#include "sim/sensor_model.hpp"

namespace berth::lab {
namespace {

/// How far one result is from the truth.
struct CalibrationError {
  double robot_m = 0;
  double clock_s = 0;
  double depth_share = 0;
  /// Of joints that were determined; NaN where none was.
  double joint = std::numeric_limits<double>::quiet_NaN();
  double halves_m = 0;
  /// Empty where the result is good.
  std::string refused;
  double time_s = 0;
};

CalibrationError error_of(const TrialRobot& robot, const DrawnTrials& trials, std::uint32_t seed) {
  sim::DrawnCalibrationData drawn =
      sim::draw_calibration_data(robot.model, robot.meshes, trials.drawn, seed);
  drawn.camera->X_PC =
      sim::miscalibrated(drawn.X_PC_true, trials.start.offset_m,
                         trials.start.angle_deg * std::numbers::pi / 180, seed + 100);
  const Stopwatch stopwatch;
  const CalibrationResult found =
      calibrate(drawn.calibration_data, {.joint_zeros = trials.joint_zeros});
  CalibrationError error;
  error.time_s = stopwatch.ms() / 1000;
  const CameraCalibration& camera = found.cameras[0];
  error.refused = camera.refused;
  error.halves_m = camera.halves_m;
  error.clock_s = std::abs(camera.clock_offset_s - trials.drawn.errors.clock_offset_s);
  // At 1.5 m, since offset and scale stand for each other.
  const double corrected_m =
      camera.depth.offset_m + camera.depth.scale * (1 + trials.drawn.errors.depth_share) * 1.5;
  error.depth_share = std::abs(corrected_m / 1.5 - 1);
  std::vector<double> joint_offsets(robot.model.joints.size(), 0.0);
  for (std::size_t j = 0; j < joint_offsets.size(); ++j) {
    const auto offset = found.joint_offsets.find(robot.model.joints[j].name);
    if (offset == found.joint_offsets.end()) continue;
    joint_offsets[j] = offset->second;
    error.joint = std::fmax(error.joint, std::abs(offset->second - drawn.joint_shift[j]));
  }
  const bool is_carried = trials.drawn.mount != sim::DrawnMount::root;
  error.robot_m =
      (is_carried ? seen_points_apart_m : robot_points_apart_m)(drawn, camera.X_PC, joint_offsets);
  return error;
}

double median_of(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return values[values.size() / 2];
}

}  // namespace

const char* const kDrawnHeading =
    "| what is wrong | calibrations | refused | robot points, median mm | worst mm | clock, worst "
    "ms | "
    "depth at 1.5 m, worst % | joints told | worst degrees | median s | worst s |\n"
    "|---|---:|---:|---:|---:|---:|---:|---:|---:|---:|---:|\n";

void measure_drawn(const std::vector<TrialRobot>& robots, const DrawnTrials& trials) {
  std::vector<double> robot_m, clock_s, depth_share, joint, time_s;
  int refused = 0;
  for (const TrialRobot& robot : robots) {
    for (int seed = 1; seed <= trials.seeds; ++seed) {
      const CalibrationError error = error_of(robot, trials, static_cast<std::uint32_t>(seed));
      if (trials.prints_each) {
        fmt::print(stderr,
                   "{} {}: {} robot {:.2f} mm (halves {:.2f}), clock {:.2f} ms, depth {:.3f} %, "
                   "joints {:.3f} deg, {:.1f} s\n",
                   robot.name, seed, error.refused, 1000 * error.robot_m, 1000 * error.halves_m,
                   1000 * error.clock_s, 100 * error.depth_share,
                   error.joint * 180 / std::numbers::pi, error.time_s);
      }
      time_s.push_back(error.time_s);
      refused += !error.refused.empty();
      if (!error.refused.empty()) continue;
      robot_m.push_back(error.robot_m);
      clock_s.push_back(error.clock_s);
      depth_share.push_back(error.depth_share);
      if (!std::isnan(error.joint)) joint.push_back(error.joint);
    }
  }
  const auto worst = [](const std::vector<double>& values) {
    return values.empty() ? std::numeric_limits<double>::quiet_NaN()
                          : *std::max_element(values.begin(), values.end());
  };
  fmt::print("| {} | {:.2f} | {:.2f} | {:.2f} | {:.3f} | {} | {:.3f} | {:.1f} | {:.1f} |\n",
             refused, 1000 * median_of(robot_m), 1000 * worst(robot_m), 1000 * worst(clock_s),
             100 * worst(depth_share), joint.size(), worst(joint) * 180 / std::numbers::pi,
             median_of(time_s), worst(time_s));
  std::fflush(stdout);
}

}  // namespace berth::lab
