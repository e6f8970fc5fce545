// Calibration: from images of a moving arm to the cameras' poses, clocks and depth errors.
#pragma once

#include <Eigen/Core>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "berth/fit/calibration_data.hpp"
#include "berth/fit/compare_estimates.hpp"

namespace berth {

/// A reading z shows a surface at offset_m + scale z.
struct DepthError {
  double offset_m = 0;
  double scale = 1;
};

/// The image with that error taken out.
DepthImage corrected(const DepthImage& depth_m, const DepthError& error);

/// What was found of one camera.
struct CameraCalibration {
  std::string camera;
  /// The pose of the optical frame in the parent link's frame P, and one standard deviation of it:
  /// of its origin, and of a small turn about the axes of P. They belong together: what moves the
  /// robot's points is halves_m.
  Pose X_PC = unset_pose();
  Eigen::Vector3d sigma_xyz_m = Eigen::Vector3d::Zero();
  Eigen::Vector3d sigma_rotation_rad = Eigen::Vector3d::Zero();
  double clock_offset_s = 0;
  double sigma_clock_s = 0;
  DepthError depth;
  /// How many pixels wider than its model the camera sees the robot, on each side.
  double dilation_px = 0;
  /// How far the points of the robot that it sees have moved from where the scene had them, in the
  /// mean.
  double moved_m = 0;
  /// How far they lie apart, in the mean, between a fit to the even and one to the odd frames: what
  /// to expect from other frames. NaN with fewer than two frames.
  double halves_m = 0;
  ResidualSpread before;
  /// With depth's error taken out.
  ResidualSpread after;
  /// How well model and images agree, at the scene's pose and at the one that is told; 2 is
  /// perfect. Where none was found, that of the best that was tried.
  double score_before = 0;
  double score_after = 0;
  /// Numbers of the frames that were used.
  std::vector<int> frames;
  /// What the frames do not tell, by its key: "pose", "clock_offset_s", "depth.offset_m",
  /// "depth.scale". It is left as it was, but for the pose.
  std::vector<std::string> not_determined;
  bool is_determined(std::string_view key) const;
  /// Whether any pose explains the images; if none does, nothing is to be used.
  bool is_found = true;
  /// Why the pose that was found is not to be used, and the start's is told; empty: it is good.
  std::string refused;
  /// The one with which a pose explains the images, where none does with the one that is believed;
  /// `refused` says so in words. None where that was not asked, or there is none.
  std::optional<double> focal_length_px = std::nullopt;
};

/// What was found of all cameras and of the joints.
struct CalibrationResult {
  /// In the order of CalibrationData::cameras.
  std::vector<CameraCalibration> cameras;
  /// Found with joint_zeros: to be added to what is believed of each joint, rad or m, by name.
  std::map<std::string, double> joint_offsets;
  std::vector<std::string> joints_not_determined;
};

/// A score for people: 100 % is perfect, what is below 40 % is the wrong place.
constexpr double fit_percent(double score) { return 50 * score; }

/// The unknowns that calibration looks for.
struct CalibrationSettings {
  /// Whether to look for the joints' zeros as well. Few frames are overfitted so.
  bool joint_zeros = false;
  /// Whether the poses are known to some centimetres. Then nothing is searched farther away, which
  /// takes a fifth of the time.
  bool is_near = false;
  /// Called now and then from the calling thread; to stop, it throws.
  std::function<void()> pause = [] {};
};

/// Fits all cameras of the calibration, on all threads that TBB gives. Each camera needs one frame
/// at least. The result depends neither on threads nor on time.
CalibrationResult calibrate(const CalibrationData& calibration_data,
                            const CalibrationSettings& settings = {});

}  // namespace berth
