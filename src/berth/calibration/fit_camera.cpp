#include "berth/calibration/fit_camera.hpp"

#include <algorithm>

#include "berth/calibration/coarse_search.hpp"
#include "berth/calibration/score.hpp"

namespace berth {
namespace {

/// About how wide the images of a coarse search are.
constexpr int kSearchWidth_px = 160;

std::vector<FitRound> near_rounds(int step) {
  return {{step, 8, 0.10, 0.08, 48, 0.08},
          {step, 6, 0.06, 0.05, 32, 0.06}};
}

std::vector<FitRound> last_rounds(int half_step) {
  return {{half_step, 5, 0.04, 0.03, 16, 0.05}, {1, 4, 0.03, 0.02, 12, 0.05}};
}

}  // namespace

std::vector<int> camera_steps(int width_px) {
  const int search = std::max(1, width_px / kSearchWidth_px);
  return {search, std::max(1, search / 2), std::max(1, search / 4), 1};
}

FitResult fit_camera(FrameDrawer& drawer, const FitPriors& priors) {
  const TeachIn& teach_in = drawer.teach_in();
  const std::vector<int> steps = camera_steps(teach_in.cameras[0]->camera.width_px);
  const CalibrationEstimate start = start_of(teach_in);
  std::vector<CalibrationEstimate> places{start};
  for (const CalibrationEstimate& place : search_coarsely(drawer, start, {.step = steps[0]})) {
    places.push_back(place);
  }
  CalibrationEstimate best = start;
  double best_score = -10;
  const Score at_start = score(drawer, start, {steps[1], 0.04, 16});
  for (const CalibrationEstimate& place : places) {
    const CalibrationEstimate fitted = fit(drawer, place, priors, near_rounds(steps[1])).estimate;
    const double fitted_score = score(drawer, fitted, {steps[1], 0.04, 16, 0.7 * at_start.pixels, 0.7 * at_start.places}).value;
    if (fitted_score > best_score) {
      best_score = fitted_score;
      best = fitted;
    }
  }
  return fit(drawer, best, priors, last_rounds(steps[2]));
}

}  // namespace berth
