// For watch/ and calibration/: least squares over all frames.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "berth/fit/frame_drawer.hpp"

namespace berth {

/// How much is known of each unknown before any image is looked at: standard deviations, of clock
/// and joints about where the fit starts, of the rest about what is expected.
struct FitPriors {
  double depth_offset_m = 0.005;
  double depth_scale = 0.02;
  double dilation_px = 3;
  double expected_depth_offset_m = 0;
  /// 0: not asked for.
  double clock_s = 0;
  /// rad or m, one for each of RobotModel::joints; 0: held where it is. Empty: all are held.
  std::vector<double> joints;
};

/// One round of a fit: images of one size, residuals up to a cut.
struct FitRound {
  int step = 1;
  int iterations = 5;
  double depth_cut_m = 0.03;
  double outline_cut_m = 0.03;
  int outline_reach_px = 10;  ///< of the sensor's image
  double outline_band_m = 0.05;
};

/// What a fit says of itself.
struct FitResult {
  CalibrationEstimate estimate;
  /// The inverse of the unknowns' covariance: those of each camera (CameraUnknown), then of joints.
  Eigen::MatrixXd information;
  /// About which the rotation of each camera's unknowns turns, in C.
  std::vector<Eigen::Vector3d> pivot_C_m;
};

/// Gauss-Newton with Tukey's weights from `start`, round after round.
FitResult fit(FrameDrawer& drawer, const CalibrationEstimate& start, const FitPriors& priors,
              const std::vector<FitRound>& rounds, FrameChoice choice = FrameChoice::all);

/// The estimate that believes what the calibration started from.
CalibrationEstimate start_of(const CalibrationData& calibration_data);

/// Turns the robot before the camera by `rotation` (rad, about an axis through `pivot_C_m`), then
/// moves it, by changing the camera's pose.
void move_robot(const Eigen::Vector3d& rotation_C, const Eigen::Vector3d& move_C_m,
                const Eigen::Vector3d& pivot_C_m, CameraEstimate& camera);

}  // namespace berth
