// Inside calibration/ only: where one camera is, looked for coarsely and then fitted.
#pragma once

#include <cstdint>
#include <functional>

#include "berth/fit/fit.hpp"
#include "berth/fit/score.hpp"

namespace berth {

struct CoarseSearch {
  int step = 8;
  /// Readings this near to the model fit, in the first round; half of it in the next, and so on.
  double cut_m = 0.15;
  /// How far from the start the robot is looked for, before the camera.
  double reach_m = 0.25;
  double reach_rad = 0.35;
  int tries = 300;
  int rounds = 3;
  /// How many of the best are returned.
  int best = 6;
};

/// How many pixels and places of its outline the robot shows in most poses of a search: a pose that
/// shows much less of it has left the image.
Score typical_size(FrameDrawer& drawer, const CalibrationEstimate& start,
                   const CoarseSearch& search);

/// Poses of one camera, drawn around `start` and, round after round, more closely around the best:
/// the best of them first. Depends on its arguments alone.
std::vector<CalibrationEstimate> search_coarsely(FrameDrawer& drawer,
                                                 const CalibrationEstimate& start,
                                                 const CoarseSearch& search, double least_pixels);

/// How a pose that was found is judged, on images of full size.
inline constexpr ScoreSettings kLastScore{1, 0.03, 10};
/// Below, the pose is a wrong place: those of other cameras and robots had 0.77 at most.
inline constexpr double kLeastScore = 0.8;
inline constexpr double kPerfectScore = 2;

/// Where a pose is looked for: from `start` alone, a fit finds what is some centimetres away.
enum class FitReach { anywhere, start };

/// The pose of one camera, from wherever it is believed to be: a fit from there, and from the best
/// places of a coarse search; the one that explains the images best. `drawer` has one camera and
/// the steps of camera_steps(). `pause` is called now and then; to stop, it throws.
FitResult fit_camera(
    FrameDrawer& drawer, const FitPriors& priors, const std::function<void()>& pause = [] {},
    FitReach reach = FitReach::anywhere);

/// The last rounds of a fit, from a place that is known well already.
FitResult refine(FrameDrawer& drawer, const CalibrationEstimate& start, const FitPriors& priors,
                 FrameChoice choice = FrameChoice::all);

/// The sizes of image that a fit needs, for images of this width.
std::vector<int> camera_steps(int width_px);

}  // namespace berth
