#include "berth/calibration/calibrate.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "berth/calibration/fit_camera.hpp"
#include "berth/calibration/focal_length.hpp"
#include "berth/calibration/uncertainty.hpp"
#include "berth/fit/compare_estimates.hpp"

namespace berth {
namespace {

/// Clocks and joints are looked for within about this.
constexpr double kClockPrior_s = 0.05;
constexpr double kJointPrior = 0.035;
/// Less certain than this counts as not determined.
constexpr double kCertainClock_s = 0.005;
constexpr double kCertainDepthScale = 0.005;
constexpr double kCertainDepthOffset_m = 0.004;
constexpr double kCertainRobot_m = 0.01;

FitPriors priors_of(const CalibrationCamera& camera) {
  FitPriors priors;
  if (camera.has_stamps) priors.clock_s = kClockPrior_s;
  return priors;
}

FitReach reach_of(const CalibrationSettings& settings) {
  return settings.is_near ? FitReach::start : FitReach::anywhere;
}

/// The calibration of one of its cameras alone.
CalibrationData alone(const CalibrationData& calibration_data, std::size_t camera) {
  CalibrationData one = calibration_data;
  one.cameras = {calibration_data.cameras[camera]};
  return one;
}

/// Joint zeros, with all cameras at once. Starts from and writes `estimate`.
void find_joint_zeros(const CalibrationData& calibration_data, FitPriors priors,
                      CalibrationEstimate& estimate, CalibrationResult& result) {
  FrameDrawer drawer(calibration_data, {2, 1});
  const std::size_t joints = calibration_data.model->joints.size();
  priors.joints.assign(joints, kJointPrior);
  const FitResult all = refine(drawer, estimate, priors);
  const std::vector<bool> determined = determined_joints(all);
  estimate = all.estimate;
  for (std::size_t j = 0; j < joints; ++j) {
    const std::string& name = calibration_data.model->joints[j].name;
    if (determined[j]) {
      result.joint_offsets[name] = estimate.joint_shift[j];
    } else {
      estimate.joint_shift[j] = 0;
      result.joints_not_determined.push_back(name);
    }
  }
  // What was found stands on all joints being free; the poses are those without the rest.
  priors.joints.clear();
  estimate = refine(drawer, estimate, priors).estimate;
}

/// Tells of one camera what the estimate of all says.
class CameraReport {
 public:
  CameraReport(const CalibrationData& calibration_data, std::size_t camera,
               const CalibrationEstimate& estimate, const CalibrationSettings& settings)
      : one_(alone(calibration_data, camera)),
        source_(*calibration_data.cameras[camera]),
        drawer_(one_, {2, 1}),
        start_(start_of(one_)),
        settings_(settings) {
    estimate_.cameras = {estimate.cameras[camera]};
    estimate_.joint_shift = estimate.joint_shift;
  }

  CameraCalibration run() {
    out_.camera = source_.name;
    for (const CalibrationFrame& frame : source_.frames) out_.frames.push_back(frame.number);
    out_.score_before = score(drawer_, start_, kLastScore).value;
    out_.score_after = score(drawer_, estimate_, kLastScore).value;
    out_.before = residuals(drawer_, start_)[0];
    judge();
    const CameraEstimate& camera = estimate_.cameras[0];
    out_.X_PC = camera.X_PC;
    out_.clock_offset_s = source_.clock_offset_s + camera.clock_shift_s;
    out_.depth = {camera.depth_offset_m, camera.depth_scale};
    out_.dilation_px = camera.dilation_px;
    out_.after = residuals(drawer_, estimate_)[0];
    out_.moved_m = displacement_m(drawer_, 2, estimate_, start_)[0];
    return std::move(out_);
  }

 private:
  void judge() {
    const double best = std::max(out_.score_before, out_.score_after);
    if (const auto other = find_better_focal_length(one_, priors_of(source_), best,
                                                    reach_of(settings_), settings_.pause)) {
      out_.is_found = false;
      refuse(fmt::format("the pose that was found fits the images by {:.0f} % only{}",
                         fit_percent(out_.score_after), focal_length_text(*other)));
    } else if (out_.score_after < kLeastScore) {
      out_.is_found = false;
      refuse(unexplained());
    } else if (out_.score_after < out_.score_before) {
      refuse(fmt::format(
          "the best one found, {:.1f} mm from it, fits the images by {:.1f} %, the scene's own by "
          "{:.1f} %",
          1000 * displacement_m(drawer_, 2, estimate_, start_)[0], fit_percent(out_.score_after),
          fit_percent(out_.score_before)));
      out_.score_after = out_.score_before;
    } else if (const double error = depth_error_share(drawer_, estimate_);
               std::abs(error) > kMostDepthError) {
      out_.is_found = false;
      refuse(
          fmt::format("a pose fits the images only if the camera reads the robot {:.0f} % too {}; "
                      "expected {:.0f} "
                      "% at most of a depth camera{}",
                      100 * std::abs(error), error < 0 ? "near" : "far", 100 * kMostDepthError,
                      focal_length_text(error)));
    } else {
      measure_uncertainty();
    }
  }

  std::string unexplained() {
    const std::string best = fmt::format(
        "no pose was found that explains the images: the best fits them by {:.0f} %; expected "
        "{:.0f} % at least",
        fit_percent(out_.score_after), fit_percent(kLeastScore));
    if (score(drawer_, start_, kLastScore).pixels > 0) return best;
    return fmt::format(
        "nothing of the robot is seen where the scene has the camera, in any of its {} "
        "frames, and {}; expected a camera that sees parts of the robot, and its pose "
        "to within 20 cm and 15 degrees",
        source_.frames.size(), best);
  }

  std::string focal_length_text(double error_share) {
    const auto other = find_focal_length(one_, priors_of(source_), error_share, reach_of(settings_),
                                         settings_.pause);
    return other ? focal_length_text(*other) : ". Check the camera's info and depth_scale";
  }

  std::string focal_length_text(const OtherFocalLength& other) {
    out_.focal_length_px = other.factor * source_.camera.fx_px;
    return fmt::format(
        ". Check the camera's info: with a focal length of {:.0f} px in place of {:.0f} px a pose "
        "fits the images by {:.0f} %, and the camera reads the robot right to {:.1f} %",
        *out_.focal_length_px, source_.camera.fx_px, fit_percent(other.score),
        100 * std::abs(other.depth_error_share));
  }

  void refuse(std::string why) {
    out_.refused = std::move(why);
    out_.halves_m = std::numeric_limits<double>::quiet_NaN();
    estimate_ = start_;
  }

  void measure_uncertainty() {
    FitPriors priors = priors_of(source_);
    const FitResult whole = refine(drawer_, estimate_, priors);
    const FitResult even = refine(drawer_, estimate_, priors, FrameChoice::even);
    const FitResult odd =
        source_.frames.size() > 1 ? refine(drawer_, estimate_, priors, FrameChoice::odd) : even;
    out_.halves_m = source_.frames.size() > 1
                        ? displacement_m(drawer_, 2, even.estimate, odd.estimate)[0]
                        : std::numeric_limits<double>::quiet_NaN();
    const CameraDeviation deviation = deviation_of(whole, even, odd, 0);
    out_.sigma_xyz_m = deviation.xyz_m;
    out_.sigma_rotation_rad = deviation.rotation_rad;
    out_.sigma_clock_s = deviation.clock_s;
    CameraEstimate& camera = estimate_.cameras[0];
    if (deviation.robot_m > kCertainRobot_m) out_.not_determined.push_back("pose");
    if (!source_.has_stamps || deviation.clock_s > kCertainClock_s) {
      out_.not_determined.push_back("clock_offset_s");
      camera.clock_shift_s = 0;
    }
    if (deviation.depth_offset_m > kCertainDepthOffset_m) {
      out_.not_determined.push_back("depth.offset_m");
    }
    if (deviation.depth_scale > kCertainDepthScale) out_.not_determined.push_back("depth.scale");
  }

  const CalibrationData one_;
  const CalibrationCamera& source_;
  FrameDrawer drawer_;
  const CalibrationEstimate start_;
  const CalibrationSettings& settings_;
  CalibrationEstimate estimate_;
  CameraCalibration out_;
};

}  // namespace

bool CameraCalibration::is_determined(std::string_view key) const {
  return std::ranges::find(not_determined, key) == not_determined.end();
}

DepthImage corrected(const DepthImage& depth_m, const DepthError& error) {
  DepthImage out = depth_m;
  for (float& z_m : out.pixels()) z_m = static_cast<float>(error.offset_m + error.scale * z_m);
  return out;
}

CalibrationResult calibrate(const CalibrationData& calibration_data,
                            const CalibrationSettings& settings) {
  CalibrationEstimate estimate = start_of(calibration_data);
  FitPriors priors;
  for (std::size_t c = 0; c < calibration_data.cameras.size(); ++c) {
    const CalibrationData one = alone(calibration_data, c);
    FrameDrawer drawer(one, camera_steps(calibration_data.cameras[c]->camera.width_px));
    const FitPriors of_camera = priors_of(*calibration_data.cameras[c]);
    estimate.cameras[c] =
        fit_camera(drawer, of_camera, settings.pause, reach_of(settings)).estimate.cameras[0];
    priors.clock_s = std::max(priors.clock_s, of_camera.clock_s);
  }
  CalibrationResult result;
  if (settings.joint_zeros) find_joint_zeros(calibration_data, priors, estimate, result);
  for (std::size_t c = 0; c < calibration_data.cameras.size(); ++c) {
    settings.pause();
    result.cameras.push_back(CameraReport(calibration_data, c, estimate, settings).run());
  }
  return result;
}

}  // namespace berth
