#include "berth/calibration/focal_length.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "berth/calibration/fit_camera.hpp"
#include "berth/fit/compare_estimates.hpp"

namespace berth {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
/// A pose that is nearer or farther makes up for most of a wrong focal length: of its logarithm,
/// this share is left as a depth error.
constexpr double kLeftAsDepth = 0.6;
constexpr double kLeastFactor = 0.45;
constexpr double kGreatestFactor = 2.2;
/// Where no fit is made, factors are tried from half to twice, 4 % apart: a fit finds the rest.
constexpr int kTriedFactors = 37;

class FocalLengthSearch {
 public:
  FocalLengthSearch(const CalibrationData& one, const FitPriors& priors, FitReach reach,
                    const std::function<void()>& pause)
      : one_(one), priors_(priors), reach_(reach), pause_(pause) {}

  /// From a fit with the focal length that is believed.
  std::optional<OtherFocalLength> from_depth_error(double error_share) {
    const auto found = by_depth_error({1, 0, error_share});
    return found ? found : from_pose(kLeastScore);
  }

  /// From the pose that is believed.
  std::optional<OtherFocalLength> from_pose(double least_score) {
    const OtherFocalLength start = best_where_believed();
    if (start.score < least_score) return std::nullopt;
    const auto found = by_depth_error(fitted(start.factor));
    return found && found->score >= least_score ? found : std::nullopt;
  }

 private:
  /// The one that explains the images best at the pose that is believed, without a fit.
  OtherFocalLength best_where_believed() {
    const int step = camera_steps(one_.cameras[0]->camera.width_px)[1];
    Material other(one_);
    OtherFocalLength best{1, -kInfinity, 0};
    for (int i = 0; i < kTriedFactors; ++i) {
      pause_();
      const double factor = std::exp2(2. * i / (kTriedFactors - 1) - 1);
      other.scale(factor);
      FrameDrawer drawer(other.data, {step});
      const double value = score(drawer, start_of(other.data), {step, 0.03, 10}).value;
      if (value > best.score) best = {factor, value, 0};
    }
    return best;
  }

  /// The images of the only camera, with another focal length.
  struct Material {
    explicit Material(const CalibrationData& one)
        : believed(one.cameras[0]->camera), camera(*one.cameras[0]), data(one) {
      data.cameras = {&camera};
    }
    void scale(double factor) {
      camera.camera.fx_px = factor * believed.fx_px;
      camera.camera.fy_px = factor * believed.fy_px;
    }
    const Camera believed;
    CalibrationCamera camera;
    CalibrationData data;
  };

  static bool explains(const OtherFocalLength& found) {
    return found.score >= kLeastScore && std::abs(found.depth_error_share) <= kMostDepthError;
  }

  /// The depth error shows which way to go, and what it then is, how far.
  std::optional<OtherFocalLength> by_depth_error(const OtherFocalLength& before) {
    if (!std::isfinite(before.depth_error_share)) return std::nullopt;
    const OtherFocalLength next =
        fitted(before.factor * std::exp(before.depth_error_share / kLeftAsDepth));
    // Where no robot is seen, there is no such error.
    if (!std::isfinite(next.depth_error_share)) return std::nullopt;
    const OtherFocalLength last = fitted(where_right(before, next));
    const OtherFocalLength& found = is_better(last, next) ? last : next;
    return explains(found) ? std::optional(found) : std::nullopt;
  }

  /// Fits the pose anew.
  OtherFocalLength fitted(double factor) {
    factor = std::clamp(factor, kLeastFactor, kGreatestFactor);
    Material other(one_);
    other.scale(factor);
    FrameDrawer drawer(other.data, camera_steps(other.camera.camera.width_px));
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
  return FocalLengthSearch(one, priors, reach, pause).from_depth_error(error_share);
}

std::optional<OtherFocalLength> find_better_focal_length(const CalibrationData& one,
                                                         const FitPriors& priors, double score,
                                                         FitReach reach,
                                                         const std::function<void()>& pause) {
  const double least_score = score + kLeastFocalGain;
  if (least_score > kPerfectScore) return std::nullopt;
  return FocalLengthSearch(one, priors, reach, pause).from_pose(least_score);
}

}  // namespace berth
