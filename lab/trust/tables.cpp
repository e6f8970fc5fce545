#include "lab/trust/tables.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>

#include "lab/bench/statistics.hpp"
#include "lab/trust/sample.hpp"

namespace berth::lab {
namespace {

/// Nearer links can lose obstacles to tolerance and padding of the self filter's defaults.
constexpr double kFar_m = 0.1;

/// Lengths above 0 among `count` ones.
struct Excess {
  std::vector<double> above_m;
  std::size_t count;

  double at(double share) const { return percentile(above_m, share).value_or(0); }
  std::string text() const {
    const double share =
        count == 0 ? 0 : 100 * static_cast<double>(above_m.size()) / static_cast<double>(count);
    return fmt::format("{:.1f} % | {:.1f} | {:.1f} | {:.1f}", share, 1e3 * at(0.5), 1e3 * at(0.99),
                       1e3 * at(1));
  }
};

/// Of sign * length_m(sample).
template <class Length>
Excess excess_of(const std::vector<Sample>& samples, Length length_m) {
  Excess excess{{}, samples.size()};
  for (const Sample& sample : samples) {
    const double m = length_m(sample);
    if (m > 0) excess.above_m.push_back(m);
  }
  return excess;
}

double over(const Sample& sample) { return sample.over_seen_m(); }
double under(const Sample& sample) { return -sample.over_seen_m(); }
double over_whole(const Sample& sample) { return sample.over_whole_m(); }

std::size_t count_lost(const std::vector<Sample>& samples) {
  return static_cast<std::size_t>(
      std::count_if(samples.begin(), samples.end(), [](const Sample& s) { return s.is_lost(); }));
}

std::string condition_row(const std::string& name, const std::vector<Sample>& all) {
  const auto covered = filtered(all, [](const Sample& s) { return s.is_covered(); });
  const auto ok = filtered(covered, [](const Sample& s) { return s.is_ok(); });
  const auto far =
      filtered(ok, [](const Sample& s) { return s.truth->seen_C.distance_m > kFar_m; });
  const auto any = filtered(all, [](const Sample& s) { return s.is_ok(); });
  const Excess whole = excess_of(any, over_whole);
  return fmt::format("| {} | {} | {} | {:.1f} | {} | {:.1f} | {:.1f} | {} |\n", name, ok.size(),
                     excess_of(ok, over).text(), 1e3 * excess_of(far, over).at(1),
                     excess_of(ok, under).text(), 1e3 * whole.at(0.99), 1e3 * whole.at(1),
                     count_lost(covered));
}

constexpr const char* kConditionHeading =
    "| | links | too large | median | 99 % | greatest | beyond 10 cm | too small | median | 99 % | "
    "greatest | whole link: 99 % | greatest | lost |\n"
    "| --- | ---: | ---: | ---: | ---: | ---: | ---: | ---: | ---: | ---: | ---: | ---: | ---: | "
    "---: |\n";

const char* name_of(sim::ObstacleSight sight) {
  switch (sight) {
    case sim::ObstacleSight::covered:
      return "seen, or behind an obstacle's reading";
    case sim::ObstacleSight::behind_robot:
      return "behind the robot";
    case sim::ObstacleSight::outside:
      break;
  }
  return "outside of the image";
}

std::string bound_row(const std::string& name, const std::vector<Sample>& samples) {
  const Excess excess = excess_of(samples, over);
  double most_px = 0;
  std::size_t above = 0;
  for (const Sample& sample : samples) {
    most_px = std::max(most_px, sample.over_px());
    if (sample.over_px() > sim::kMaxOverestimate_px) ++above;
  }
  return fmt::format("| {} | {} | {} | {:.2f} | {} |\n", name, samples.size(), excess.text(),
                     most_px, above);
}

}  // namespace

std::string condition_tables(const std::vector<Trial>& trials,
                             const std::vector<Condition>& conditions) {
  std::string text;
  for (std::size_t i = 0; i < conditions.size(); ++i) {
    const bool is_first = i == 0 || conditions[i].table != conditions[i - 1].table;
    if (is_first) text += fmt::format("\n## {}\n{}", conditions[i].table, kConditionHeading);
    text += condition_row(conditions[i].name, samples_of(trials, i));
  }
  return text;
}

std::string sight_table(const std::vector<Trial>& trials, std::size_t condition) {
  std::string text =
      "| the obstacle's nearest point | links | too large | median | 99 % | greatest | lost |\n"
      "| --- | ---: | ---: | ---: | ---: | ---: | ---: |\n";
  const auto visible = filtered(samples_of(trials, condition), [](const Sample& s) {
    return s.estimate->status != LinkStatus::not_visible &&
           std::isfinite(s.truth->seen_C.distance_m);
  });
  for (const auto sight : {sim::ObstacleSight::covered, sim::ObstacleSight::behind_robot,
                           sim::ObstacleSight::outside}) {
    const auto some = filtered(visible, [&](const Sample& s) { return s.truth->sight == sight; });
    const auto ok = filtered(some, [](const Sample& s) { return s.is_ok(); });
    text += fmt::format("| {} | {} | {} | {} |\n", name_of(sight), some.size(),
                        excess_of(ok, over).text(), count_lost(some));
  }
  return text;
}

std::string bound_table(const std::vector<Trial>& trials, std::size_t condition) {
  std::string text =
      "| | links | too large | median | 99 % | greatest | pixels beyond the metric | above the "
      "bound |\n| --- | ---: | ---: | ---: | ---: | ---: | ---: | ---: |\n";
  std::map<std::string, std::vector<Sample>> rows;
  for (const Sample& sample : samples_of(trials, condition)) {
    if (!sample.is_ok() || !sample.is_covered()) continue;
    const Camera& camera = sample.trial->camera;
    rows[sample.trial->robot->name].push_back(sample);
    rows[fmt::format("{} x {}", camera.width_px, camera.height_px)].push_back(sample);
  }
  for (const auto& [name, samples] : rows) text += bound_row(name, samples);
  return text;
}

std::string worst_table(const std::vector<Trial>& trials, std::size_t condition, int count) {
  std::vector<Sample> samples = filtered(
      samples_of(trials, condition), [](const Sample& s) { return s.is_ok() && s.is_covered(); });
  std::sort(samples.begin(), samples.end(), [](const Sample& a, const Sample& b) {
    return std::tuple(a.over_seen_m(), a.trial->seed) > std::tuple(b.over_seen_m(), b.trial->seed);
  });
  std::string text =
      "| robot | seed | image | link | berth | true | too large | bound | angle |\n"
      "| --- | ---: | --- | --- | ---: | ---: | ---: | ---: | ---: |\n";
  for (std::size_t i = 0; i < samples.size() && i < static_cast<std::size_t>(count); ++i) {
    const Sample& s = samples[i];
    const Eigen::Vector3d& ray = s.truth->seen_C.b_m;
    text +=
        fmt::format("| {} | {} | {} x {} | {} | {:.1f} | {:.1f} | {:.1f} | {:.1f} | {:.0f}° |\n",
                    s.trial->robot->name, s.trial->seed, s.trial->camera.width_px,
                    s.trial->camera.height_px, s.trial->robot->model.evaluated_link_names()[s.link],
                    1e3 * s.estimate->distance_m, 1e3 * s.truth->seen_C.distance_m,
                    1e3 * s.over_seen_m(), 1e3 * sim::max_overestimate_m(s.trial->camera, *s.truth),
                    std::atan2(ray.head<2>().norm(), ray.z()) * 57.29578);
  }
  return text;
}

}  // namespace berth::lab
