// Inside calibration/ only.
#pragma once

#include <functional>
#include <optional>

#include "berth/calibration/fit_camera.hpp"
#include "berth/fit/fit.hpp"

namespace berth {

/// No depth camera reads the robot by a greater share of its depth too near or too far: those of
/// real cameras are up to 0.02, those of a focal length that is 10 % off 0.05 and more.
inline constexpr double kMostDepthError = 0.04;

/// Of a score, of which 2 is perfect. Three recorded and the bundled cameras, with their own focal
/// length, gained less with another one; with one that was 20 % off most gained more.
inline constexpr double kLeastFocalGain = 0.3;

/// How much too far a camera reads the robot at an estimate, as a share of its mean depth: negative
/// where too near. NaN where it sees no robot. `drawer` has one camera and images at step 2.
double depth_error_share(FrameDrawer& drawer, const CalibrationEstimate& estimate);

/// Another focal length, and how well the camera's images fit with it.
struct OtherFocalLength {
  /// Times the one that is believed.
  double factor = 1;
  double score = 0;
  double depth_error_share = 0;
};

/// A focal length with which a pose explains the images of the only camera and its depth error is
/// one that depth cameras have; none where there is none from half to twice the one that is
/// believed. `error_share`: that of the fit with the one that is believed. `reach` and `pause` as
/// in fit_camera().
std::optional<OtherFocalLength> find_focal_length(const CalibrationData& one,
                                                  const FitPriors& priors, double error_share,
                                                  FitReach reach,
                                                  const std::function<void()>& pause);

/// The same where the best fit with the focal length that is believed explains the images badly, or
/// not at all: one whose score is better by kLeastFocalGain, at the pose that is believed already.
/// `score`: that of the fit.
std::optional<OtherFocalLength> find_better_focal_length(const CalibrationData& one,
                                                         const FitPriors& priors, double score,
                                                         FitReach reach,
                                                         const std::function<void()>& pause);

}  // namespace berth
