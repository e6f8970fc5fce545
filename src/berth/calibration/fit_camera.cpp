#include "berth/calibration/fit_camera.hpp"

#include <algorithm>

#include "berth/calibration/coarse_search.hpp"

namespace berth {
namespace {

/// About how wide the images of a coarse search are.
constexpr int kSearchWidth_px = 160;

std::vector<FitRound> near_rounds(int step) {
  return {{step, 8, 0.10, 0.08, 48, 0.08}, {step, 6, 0.06, 0.05, 32, 0.06}};
}

const std::vector<FitRound> kLastRounds{{2, 5, 0.04, 0.03, 16, 0.05}, {1, 4, 0.03, 0.02, 12, 0.05}};

/// A fit that agrees with the images less than this may be at a wrong place: 2 is perfect, wrong
/// places of real robots have 0.6 at most, right ones of real cameras 1.2 and more.
constexpr double kGoodScore = 1.0;
/// For starts that are farther off.
constexpr CoarseSearch kWideSearch{.reach_m = 0.3, .reach_rad = 0.45, .tries = 1500, .best = 16};
/// Of what the robot shows in most poses.
constexpr double kLeastShare = 0.6;

struct Place {
  CalibrationEstimate estimate;
  double score = -10;
};

/// The pose that explains the images best, of fits from the start and from the best of a search.
class PlaceSearch {
 public:
  PlaceSearch(FrameDrawer& drawer, const FitPriors& priors, const std::vector<int>& steps,
              const std::function<void()>& pause)
      : drawer_(drawer),
        near_(priors),
        steps_(steps),
        pause_(pause),
        start_(start_of(drawer.calibration_data())) {
    // Sensor faults of a few millimetres must not explain decimetres.
    near_.depth_offset_m = 0;
    near_.depth_scale = 0;
    near_.dilation_px = 0;
  }

  Place run(CoarseSearch search) {
    search.step = steps_[0];
    const Score size = typical_size(drawer_, start_, search);
    Place best;
    std::vector<CalibrationEstimate> places =
        search_coarsely(drawer_, start_, search, kLeastShare * size.pixels);
    places.push_back(start_);
    for (const CalibrationEstimate& place : places) {
      Place fitted{fitted_from(place)};
      const double per_pixel = static_cast<double>(steps_[0]) / steps_[1];
      fitted.score = score(drawer_, fitted.estimate,
                           {steps_[1], 0.04, 16, kLeastShare * size.pixels * per_pixel * per_pixel,
                            kLeastShare * size.places * per_pixel})
                         .value;
      if (fitted.score > best.score) best = std::move(fitted);
    }
    return best;
  }

  CalibrationEstimate from_start() { return fitted_from(start_); }

 private:
  CalibrationEstimate fitted_from(const CalibrationEstimate& place) {
    pause_();
    return fit(drawer_, place, near_, near_rounds(steps_[1])).estimate;
  }

  FrameDrawer& drawer_;
  FitPriors near_;
  const std::vector<int>& steps_;
  const std::function<void()>& pause_;
  const CalibrationEstimate start_;
};

}  // namespace

std::vector<int> camera_steps(int width_px) {
  const int search = std::max(1, width_px / kSearchWidth_px);
  return {search, std::max(1, search / 2), 2, 1};
}

FitResult fit_camera(FrameDrawer& drawer, const FitPriors& priors,
                     const std::function<void()>& pause, FitReach reach) {
  const std::vector<int> steps =
      camera_steps(drawer.calibration_data().cameras[0]->camera.width_px);
  PlaceSearch search(drawer, priors, steps, pause);
  if (reach == FitReach::start) return refine(drawer, search.from_start(), priors);
  Place place = search.run({});
  if (place.score < kGoodScore) {
    Place wide = search.run(kWideSearch);
    if (wide.score > place.score) place = std::move(wide);
  }
  return refine(drawer, place.estimate, priors);
}

FitResult refine(FrameDrawer& drawer, const CalibrationEstimate& start, const FitPriors& priors,
                 FrameChoice choice) {
  return fit(drawer, start, priors, kLastRounds, choice);
}

}  // namespace berth
