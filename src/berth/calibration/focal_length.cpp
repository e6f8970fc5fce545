#include "berth/calibration/focal_length.hpp"

#include <algorithm>
#include <cmath>

#include "berth/calibration/fit_camera.hpp"
#include "berth/fit/compare_estimates.hpp"

namespace berth {
namespace {

/// A pose that is nearer or farther makes up for most of a wrong focal length: of its logarithm,
/// this share is left as a depth error.
constexpr double kLeftAsDepth = 0.6;
constexpr double kLeastFactor = 0.45;
constexpr double kGreatestFactor = 2.2;

class FocalLengthSearch {
 public:
  FocalLengthSearch(const CalibrationData& one, const FitPriors& priors, FitReach reach,
                    const std::function<void()>& pause)
      : one_(one), priors_(priors), reach_(reach), pause_(pause) {}

  std::optional<OtherFocalLength> run(double error_share) {
    const OtherFocalLength before{1, 0, error_share};
    OtherFocalLength next = fitted(std::exp(error_share / kLeftAsDepth));
    const OtherFocalLength last = fitted(where_right(before, next));
    if (is_better(last, next)) next = last;
    const bool explains =
        next.score >= kLeastScore && std::abs(next.depth_error_share) <= kMostDepthError;
    return explains ? std::optional(next) : std::nullopt;
  }

 private:
  /// Fits the pose anew.
  OtherFocalLength fitted(double factor) {
    factor = std::clamp(factor, kLeastFactor, kGreatestFactor);
    CalibrationCamera camera = *one_.cameras[0];
    camera.camera.fx_px *= factor;
    camera.camera.fy_px *= factor;
    CalibrationData other = one_;
    other.cameras = {&camera};
    FrameDrawer drawer(other, camera_steps(camera.camera.width_px));
    const CalibrationEstimate estimate = fit_camera(drawer, priors_, pause_, reach_).estimate;
    return {factor, score(drawer, estimate, kLastScore).value, depth_error_share(drawer, estimate)};
  }

  /// Where the line through both says that the depth error is 0.
  static double where_right(const OtherFocalLength& a, const OtherFocalLength& b) {
    const double rise = b.depth_error_share - a.depth_error_share;
    if (std::abs(rise) < 1e-3) return b.factor;
    const double log_step = std::log(b.factor / a.factor) * b.depth_error_share / rise;
    return b.factor * std::exp(-std::clamp(log_step, -0.2, 0.2));
  }

  static bool is_better(const OtherFocalLength& a, const OtherFocalLength& b) {
    if (a.score < kLeastScore) return false;
    return std::abs(a.depth_error_share) < std::abs(b.depth_error_share);
  }

  const CalibrationData& one_;
  const FitPriors& priors_;
  FitReach reach_;
  const std::function<void()>& pause_;
};

}  // namespace

double depth_error_share(FrameDrawer& drawer, const CalibrationEstimate& estimate) {
  const double depth_m = robot_depth_m(drawer, 2, estimate)[0];
  const CameraEstimate& camera = estimate.cameras[0];
  return (depth_m - camera.depth_offset_m) / (camera.depth_scale * depth_m) - 1;
}

std::optional<OtherFocalLength> find_focal_length(const CalibrationData& one,
                                                  const FitPriors& priors, double error_share,
                                                  FitReach reach,
                                                  const std::function<void()>& pause) {
  return FocalLengthSearch(one, priors, reach, pause).run(error_share);
}

}  // namespace berth
