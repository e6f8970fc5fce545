#include "berth/calibration/fit_camera.hpp"

#include <algorithm>
#include <random>

#include "berth/fit/score.hpp"

namespace berth {
namespace {

constexpr std::uint32_t kSeed = 1;
constexpr double kLastCut_m = 0.06;
constexpr int kSizeTries = 31;
constexpr int kLargeSize = 24;
/// Of the reach, in the rounds after the first.
constexpr double kLaterTurn = 0.5;

struct Tried {
  CalibrationEstimate estimate;
  double score;
};

/// The camera turns about itself, and moves.
CalibrationEstimate moved(const CalibrationEstimate& from, const Eigen::Vector3d& most_turn_rad,
                          const Eigen::Vector3d& most_move_m, std::mt19937& random) {
  std::uniform_real_distribution<double> part(-1, 1);
  const auto draw = [&] { return Eigen::Vector3d(part(random), part(random), part(random)); };
  CalibrationEstimate to = from;
  const Eigen::Vector3d turn_rad = most_turn_rad.cwiseProduct(draw());
  const Eigen::Vector3d move_m = most_move_m.cwiseProduct(draw());
  move_robot(turn_rad, move_m, Eigen::Vector3d::Zero(), to.cameras[0]);
  return to;
}

/// Of the first round: to move sideways is to turn, nearly, and four unknowns can be searched more
/// closely than six.
CalibrationEstimate turned(const CalibrationEstimate& from, const CoarseSearch& search,
                           std::mt19937& random) {
  const double turn = search.reach_rad;
  return moved(from, {turn, turn, turn / 2}, {0, 0, search.reach_m}, random);
}

void keep_best(std::size_t count, std::vector<Tried>& tried) {
  std::stable_sort(tried.begin(), tried.end(),
                   [](const Tried& a, const Tried& b) { return a.score > b.score; });
  if (tried.size() > count) tried.resize(count);
}

}  // namespace

Score typical_size(FrameDrawer& drawer, const CalibrationEstimate& start,
                   const CoarseSearch& search) {
  std::mt19937 random(kSeed);
  std::vector<double> pixels;
  std::vector<double> places;
  for (int i = 0; i < kSizeTries; ++i) {
    const CalibrationEstimate to = turned(start, search, random);
    const Score one = score(drawer, to, {search.step, 1, 1});
    pixels.push_back(one.pixels);
    places.push_back(one.places);
  }
  const auto large = [](std::vector<double>& values) {
    std::nth_element(values.begin(), values.begin() + kLargeSize, values.end());
    return values[kLargeSize];
  };
  return {0, large(pixels), large(places)};
}

std::vector<CalibrationEstimate> search_coarsely(FrameDrawer& drawer,
                                                 const CalibrationEstimate& start,
                                                 const CoarseSearch& search, double least_pixels) {
  std::mt19937 random(kSeed);
  std::vector<Tried> best{{start, 0}};
  for (int round = 0; round < search.rounds; ++round) {
    const double shrink = std::pow(0.5, round);
    const double cut_m = std::max(kLastCut_m, search.cut_m * shrink);
    const auto score_of = [&](const CalibrationEstimate& estimate) {
      return score(drawer, estimate, {search.step, cut_m, 0, least_pixels}).value;
    };
    std::vector<Tried> tried;
    for (const Tried& one : best) tried.push_back({one.estimate, score_of(one.estimate)});
    for (int i = 0; i < search.tries; ++i) {
      const CalibrationEstimate& from = best[i % best.size()].estimate;
      const CalibrationEstimate to =
          round == 0
              ? turned(from, search, random)
              : moved(from, Eigen::Vector3d::Constant(shrink * kLaterTurn * search.reach_rad),
                      Eigen::Vector3d::Constant(shrink * search.reach_m), random);
      tried.push_back({to, score_of(to)});
    }
    const bool is_last = round + 1 == search.rounds;
    keep_best(static_cast<std::size_t>(search.best) * (is_last ? 1 : 4), tried);
    best = std::move(tried);
  }
  std::vector<CalibrationEstimate> found;
  for (Tried& one : best) found.push_back(std::move(one.estimate));
  return found;
}

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
