#include <fmt/format.h>

#include <algorithm>

#include "lab/trust/whole_robot_tables.hpp"

namespace berth::lab {
namespace {

constexpr std::size_t kThreeCameras = 2;
/// A link at least this far from everything is not in contact.
constexpr double kClear_m = 0.05;
constexpr double kFar_m = 0.02;
constexpr double kVeryFar_m = 0.06;

double percent(int part, int whole) { return whole == 0 ? 0 : 100.0 * part / whole; }

struct MonitorCount {
  int links = 0;
  int zeros = 0;
  int zero_readings = 0;
  int scenes_with_zero = 0;
  int in_image = 0;
  int far = 0;
  int very_far = 0;
  double greatest_m = 0;

  void add(const WholeRobotTrial& trial, std::size_t condition) {
    const auto& said = trial.under[condition].mesh[kThreeCameras];
    const int zeros_before = zeros;
    for (std::size_t i = 0; i < trial.truth.size(); ++i) {
      const WholeRobotTruth& truth = trial.truth[i];
      const bool is_clear = truth.distance_m > kClear_m;
      ++links;
      zeros += is_clear && said[i].nearest_m < kTrialTolerance_m;
      zero_readings += is_clear && said[i].reading_m < kTrialTolerance_m;
      if (truth.sight[kThreeCameras] != sim::ObstacleSight::covered) continue;
      const double over_m =
          std::min(said[i].nearest_m, kTrialRange_m) - std::min(truth.distance_m, kTrialRange_m);
      ++in_image;
      far += over_m > kFar_m;
      very_far += over_m > kVeryFar_m;
      greatest_m = std::max(greatest_m, over_m);
    }
    scenes_with_zero += zeros > zeros_before;
  }
};

}  // namespace

std::string monitor_table(const std::vector<WholeRobotTrial>& trials,
                          const std::vector<WholeRobotCondition>& conditions) {
  std::string text =
      "\n### What a monitor gets from three cameras\n"
      "| | links | 0 though > 5 cm | a reading | scenes with one | in an image | > 2 cm too far | "
      "> 6 cm | greatest |\n"
      "| --- | ---: | ---: | ---: | ---: | ---: | ---: | ---: | ---: |\n";
  for (std::size_t c = 0; c < conditions.size(); ++c) {
    MonitorCount count;
    for (const WholeRobotTrial& trial : trials) count.add(trial, c);
    text += fmt::format(
        "| {} | {} | {:.1f} % | {:.1f} % | {:.0f} % | {} | {:.1f} % | {} | {:.1f} |\n",
        conditions[c].name, count.links, percent(count.zeros, count.links),
        percent(count.zero_readings, count.links),
        percent(count.scenes_with_zero, static_cast<int>(trials.size())), count.in_image,
        percent(count.far, count.in_image), count.very_far, 1e3 * count.greatest_m);
  }
  return text;
}

}  // namespace berth::lab
