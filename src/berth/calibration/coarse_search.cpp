#include "berth/calibration/coarse_search.hpp"

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

}  // namespace berth
