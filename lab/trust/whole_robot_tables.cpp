#include "lab/trust/whole_robot_tables.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <optional>
#include <utility>

#include "lab/bench/statistics.hpp"

namespace berth::lab {
namespace {

/// A link at least this far from everything is not in contact.
constexpr double kFree_m = 0.05;

constexpr const char* kHeading =
    "| | links | too large | median | 99 % | greatest | too small | median | 0 though > 5 cm | "
    "lost "
    "|\n| --- | ---: | ---: | ---: | ---: | ---: | ---: | ---: | ---: | ---: |\n";

constexpr std::array<std::pair<sim::ObstacleSight, const char*>, 3> kSights = {
    {{sim::ObstacleSight::covered, "in an image"},
     {sim::ObstacleSight::behind_robot, "behind the robot"},
     {sim::ObstacleSight::outside, "outside of all images"}}};

std::string cameras(std::size_t count) {
  return fmt::format("{} camera{}", count, count > 1 ? "s" : "");
}

/// One link's distance and the true one. What says that nothing is in range says the range.
struct Compared {
  double said_m;
  double true_m;
  bool is_lost() const { return std::isinf(said_m) && true_m <= kTrialRange_m; }
  double over_m() const {
    return std::min(said_m, kTrialRange_m) - std::min(true_m, kTrialRange_m);
  }
};

double percent(std::size_t part, std::size_t whole) {
  return whole == 0 ? 0 : 100.0 * static_cast<double>(part) / static_cast<double>(whole);
}

std::string row(const std::string& name, const std::vector<Compared>& links) {
  std::vector<double> over_m, under_m;
  std::size_t zeros = 0, lost = 0;
  for (const Compared& link : links) {
    if (link.over_m() > kTrialTolerance_m) over_m.push_back(link.over_m());
    if (link.over_m() < -kTrialTolerance_m) under_m.push_back(-link.over_m());
    zeros += link.said_m < kTrialTolerance_m && link.true_m > kFree_m;
    lost += link.is_lost();
  }
  const auto at_mm = [](const std::vector<double>& lengths_m, double share) {
    return 1e3 * percentile(lengths_m, share).value_or(0);
  };
  return fmt::format(
      "| {} | {} | {:.1f} % | {:.1f} | {:.1f} | {:.1f} | {:.1f} % | {:.1f} | {:.1f} "
      "% | {} |\n",
      name, links.size(), percent(over_m.size(), links.size()), at_mm(over_m, 0.5),
      at_mm(over_m, 0.99), at_mm(over_m, 1), percent(under_m.size(), links.size()),
      at_mm(under_m, 0.5), percent(zeros, links.size()), lost);
}

/// said_m(trial, link) is empty where nothing is claimed.
std::vector<Compared> compare(
    const std::vector<WholeRobotTrial>& trials,
    const std::function<std::optional<double>(const WholeRobotTrial&, std::size_t)>& said_m) {
  std::vector<Compared> links;
  for (const WholeRobotTrial& trial : trials) {
    for (std::size_t i = 0; i < trial.truth.size(); ++i) {
      if (const auto m = said_m(trial, i)) links.push_back({*m, trial.truth[i].distance_m});
    }
  }
  return links;
}

std::optional<double> exact_m(const Estimate& estimate) {
  if (estimate.status == LinkStatus::not_visible) return std::nullopt;
  return estimate.status == LinkStatus::ok ? estimate.distance_m
                                           : std::numeric_limits<double>::infinity();
}

}  // namespace

std::string whole_robot_table(const std::vector<WholeRobotTrial>& trials,
                              const std::vector<WholeRobotCondition>& conditions) {
  std::string text;
  for (std::size_t c = 0; c < conditions.size(); ++c) {
    text += fmt::format("\n### {}\n{}", conditions[c].name, kHeading);
    text += row("`exact`, 1 camera", compare(trials, [&](const WholeRobotTrial& t, std::size_t i) {
                  return exact_m(t.under[c].exact[i]);
                }));
    for (std::size_t k = 0; k < kMostTrialCameras; ++k) {
      text += row("`mesh`, seen or hidden, " + cameras(k + 1),
                  compare(trials, [&](const WholeRobotTrial& t, std::size_t i) {
                    return t.under[c].mesh[k][i].nearest_m;
                  }));
    }
    for (std::size_t k = 0; k < kMostTrialCameras; ++k) {
      text += row("`mesh`, readings alone, " + cameras(k + 1),
                  compare(trials, [&](const WholeRobotTrial& t, std::size_t i) {
                    return t.under[c].mesh[k][i].reading_m;
                  }));
    }
  }
  return text;
}

std::string whole_robot_sight_table(const std::vector<WholeRobotTrial>& trials,
                                    std::size_t condition) {
  std::string text = kHeading;
  const auto add = [&](const std::string& name, sim::ObstacleSight sight, std::size_t k,
                       const std::function<double(const WholeRobotTrial&, std::size_t)>& said_m) {
    text += row(name, compare(trials, [&](const WholeRobotTrial& t, std::size_t i) {
                  return t.truth[i].sight[k] == sight ? std::optional(said_m(t, i)) : std::nullopt;
                }));
  };
  for (std::size_t k = 0; k < kMostTrialCameras; ++k) {
    for (const auto& [sight, name] : kSights) {
      add(fmt::format("{}, seen or hidden: {}", cameras(k + 1), name), sight, k,
          [&](const auto& t, std::size_t i) { return t.under[condition].mesh[k][i].nearest_m; });
    }
    add(cameras(k + 1) + ", readings alone: in an image", sim::ObstacleSight::covered, k,
        [&](const auto& t, std::size_t i) { return t.under[condition].mesh[k][i].reading_m; });
  }
  return text;
}

std::string worst_whole_robot_table(const std::vector<WholeRobotTrial>& trials,
                                    std::size_t condition, int count) {
  struct Worst {
    const WholeRobotTrial* trial;
    std::size_t link;
    Compared compared;
  };
  std::string text =
      "| cameras | obstacle | robot | seed | link | berth | true | too large |\n"
      "| ---: | --- | --- | ---: | --- | ---: | ---: | ---: |\n";
  const auto add = [&](std::size_t k, sim::ObstacleSight sight, const char* name) {
    std::vector<Worst> worst;
    for (const WholeRobotTrial& trial : trials) {
      for (std::size_t i = 0; i < trial.truth.size(); ++i) {
        if (trial.truth[i].sight[k] != sight) continue;
        worst.push_back(
            {&trial, i, {trial.under[condition].mesh[k][i].nearest_m, trial.truth[i].distance_m}});
      }
    }
    std::sort(worst.begin(), worst.end(), [](const Worst& a, const Worst& b) {
      return a.compared.over_m() > b.compared.over_m();
    });
    for (std::size_t i = 0; i < worst.size() && i < static_cast<std::size_t>(count); ++i) {
      const auto& [trial, link, compared] = worst[i];
      if (compared.over_m() <= kTrialTolerance_m) break;
      text += fmt::format("| {} | {} | {} | {} | {} | {:.1f} | {:.1f} | {:.1f} |\n", k + 1, name,
                          trial->robot->name, trial->seed,
                          trial->robot->model.evaluated_link_names()[link], 1e3 * compared.said_m,
                          1e3 * compared.true_m, 1e3 * compared.over_m());
    }
  };
  for (std::size_t k = 0; k < kMostTrialCameras; ++k) {
    for (const auto& [sight, name] : kSights) add(k, sight, name);
  }
  return text;
}

}  // namespace berth::lab
