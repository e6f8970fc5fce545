#include "lab/filter/truth_rows.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>

#include "lab/measure/each_alone.hpp"
#include "lab/trust/real_image.hpp"
#include "lab/trust/sample.hpp"

namespace berth::lab {
namespace {

constexpr const char* kDefaultSettings = "defaults: ";
constexpr const char* kSettingsTable = "Settings of the self filter: ";

/// Each kind of sensor that berth_trust tries the self filter's settings on, its settings the
/// default ones.
std::vector<Condition> sensors() {
  std::vector<Condition> found;
  for (const Condition& condition : all_conditions()) {
    if (condition.table.starts_with(kSettingsTable) && condition.name.starts_with(kDefaultSettings))
      found.push_back(condition);
  }
  return found;
}

std::vector<Condition> with_choices(const Condition& sensor,
                                    const std::vector<FilterChoice>& choices) {
  std::vector<Condition> conditions;
  for (const FilterChoice& choice : choices) {
    conditions.push_back(sensor);
    conditions.back().self_filter = choice.filter;
    conditions.push_back(conditions.back());
    conditions.back().counts_rejected = true;
  }
  return conditions;
}

/// Lengths above 0.
struct Excess {
  std::vector<double> length_m;
  std::size_t links = 0;

  void add(double m) {
    ++links;
    if (m > 0) length_m.push_back(m);
  }
  double at_mm(double share) {
    if (length_m.empty()) return 0;
    const auto rank = static_cast<std::size_t>(share * static_cast<double>(length_m.size() - 1));
    std::nth_element(length_m.begin(), length_m.begin() + static_cast<std::ptrdiff_t>(rank),
                     length_m.end());
    return 1e3 * length_m[rank];
  }
  double share_percent() const {
    return 100 * static_cast<double>(length_m.size()) /
           static_cast<double>(std::max<std::size_t>(1, links));
  }
};

constexpr double kFar_m = 0.1;         ///< farther than what tolerance and padding take
constexpr double kFalseZero_m = 0.02;  ///< a distance of 0 where nothing is nearer than this

std::string row(const std::string& cells, const std::vector<Trial>& trials, std::size_t condition) {
  Excess over, under, far, over_rejected;
  int zeros = 0, lost = 0;
  const auto covered = [&](std::size_t i) {
    return filtered(samples_of(trials, i), [](const Sample& s) { return s.is_covered(); });
  };
  for (const Sample& sample : covered(condition)) {
    lost += sample.is_lost();
    if (!sample.is_ok()) continue;
    const double over_m = sample.over_seen_m();
    over.add(over_m);
    under.add(-over_m);
    if (sample.truth->seen_C.distance_m > kFar_m) far.add(over_m);
    zeros += sample.estimate->distance_m <= 0 && sample.truth->seen_C.distance_m > kFalseZero_m;
  }
  for (const Sample& sample : covered(condition + 1)) {
    if (sample.is_ok()) over_rejected.add(sample.over_seen_m());
  }
  return fmt::format(
      "{}| {:.1f} | {:.0f} | {:.0f} | {:.0f} | {:.0f} | {:.0f} | {:.1f} | {:.0f} | {} | {} |\n",
      cells, over.share_percent(), over.at_mm(0.99), over.at_mm(1), far.at_mm(1),
      over_rejected.at_mm(0.99), over_rejected.at_mm(1), under.share_percent(), under.at_mm(0.5),
      zeros, lost);
}

/// Of links that are farther than with the ideal filter.
struct RealRow {
  Excess farther, farther_rejected;
  int zeros = 0, lost = 0;

  void add(const LinkDistance& ideal, const Estimate& estimate, const Estimate& rejected) {
    constexpr double kRounding_m = 1e-5;
    if (ideal.status != LinkStatus::ok) return;
    lost += estimate.status != LinkStatus::ok;
    if (estimate.status == LinkStatus::ok)
      farther.add(std::max(0.0, estimate.distance_m - ideal.distance_m - kRounding_m));
    if (rejected.status == LinkStatus::ok)
      farther_rejected.add(std::max(0.0, rejected.distance_m - ideal.distance_m - kRounding_m));
    zeros += estimate.distance_m <= 0 && ideal.distance_m > kFalseZero_m;
  }
};

}  // namespace

void print_drawn_truth(const FilterGrid& grid, const std::vector<TrialRobot>& robots, int scenes) {
  const std::vector<FilterChoice> choices = grid.choices();
  for (const Condition& sensor : sensors()) {
    const std::vector<Condition> conditions = with_choices(sensor, choices);
    const std::vector<Trial> trials = run_trials(robots, conditions, scenes);
    fmt::print(
        "\n## {} drawn scenes; {}\n{}| too large % | 99 % | greatest | beyond 10 cm | with "
        "rejected: "
        "99 % | greatest | too small % | median | false 0 | lost |\n",
        scenes, sensor.table.substr(std::string(kSettingsTable).size()), grid.heading());
    for (std::size_t i = 0; i < choices.size(); ++i)
      fmt::print("{}", row(choices[i].cells, trials, 2 * i));
    std::fflush(stdout);
  }
}

void print_real_images(const FilterGrid& grid, const std::vector<TrialRobot>& robots,
                       const std::filesystem::path& folder, int scenes) {
  const std::vector<RealImage> images = load_real_images(folder);
  const std::vector<FilterChoice> choices = grid.choices();
  std::vector<std::optional<RealScene>> drawn(scenes);
  each_alone(scenes, [&](int i) {
    drawn[i] = draw_into(images[i % images.size()], robots[i / images.size() % robots.size()],
                         static_cast<std::uint32_t>(i));
  });
  fmt::print(
      "\n## Robots in real images, {} tries\n{}| links | farther % | median | 99 % | greatest | "
      "with "
      "rejected: 99 % | greatest | false 0 | lost |\n",
      scenes, grid.heading());
  std::vector<RealRow> rows(choices.size());
  each_alone(static_cast<int>(choices.size()), [&](int c) {
    const RealImageRules rules{"", choices[c].filter, choices[c].sensor};
    RealImageRules rejected_rules = rules;
    rejected_rules.counts_rejected = true;
    for (const auto& scene : drawn) {
      if (!scene) continue;
      const auto estimates = estimate(*scene, rules);
      const auto rejected = estimate(*scene, rejected_rules);
      for (std::size_t link = 0; link < estimates.size(); ++link)
        rows[c].add(scene->ideal.links[link], estimates[link], rejected[link]);
    }
  });
  for (std::size_t c = 0; c < choices.size(); ++c) {
    RealRow& r = rows[c];
    fmt::print("{}| {} | {:.1f} | {:.0f} | {:.0f} | {:.0f} | {:.0f} | {:.0f} | {} | {} |\n",
               choices[c].cells, r.farther.links, r.farther.share_percent(), r.farther.at_mm(0.5),
               r.farther.at_mm(0.99), r.farther.at_mm(1), r.farther_rejected.at_mm(0.99),
               r.farther_rejected.at_mm(1), r.zeros, r.lost);
  }
}

}  // namespace berth::lab
