#include "lab/closed_loop/table.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "lab/closed_loop/path.hpp"

namespace berth::lab {
namespace {

std::string row(const Policy& policy, const std::vector<EncounterResult>& results) {
  int contacts = 0, touches = 0;
  double fastest_m_s = 0, duration_s = 0, phase_s = 0, stopped_s = 0;
  double known_m = std::numeric_limits<double>::infinity();
  std::vector<double> least_m;
  for (const EncounterResult& result : results) {
    contacts += result.contact_m_s > 0;
    touches += result.has_touched;
    fastest_m_s = std::max(fastest_m_s, result.contact_m_s);
    duration_s += result.duration_s;
    phase_s += result.phase_s;
    stopped_s += result.stopped_share * result.duration_s;
    known_m = std::min(known_m, result.least_known_m);
    least_m.push_back(result.least_moving_m);
  }
  std::ranges::sort(least_m);
  const auto centimetres = [](double m) { return fmt::format("{:.1f} cm", 100 * m); };
  return fmt::format("| {} | {} | {:.2f} | {} | {} | {} | {} | {:.1f} s | {:.0f} % |\n",
                     policy.sentence, contacts, fastest_m_s, touches - contacts,
                     centimetres(least_m.front()), centimetres(least_m[least_m.size() / 2]),
                     centimetres(known_m), cycle_s() * duration_s / phase_s,
                     100 * stopped_s / duration_s);
}

std::string census_rows(const Policy& policy, const std::vector<EncounterResult>& results) {
  LostTimes all;
  double all_s = 0, duration_s = 0;
  for (const EncounterResult& result : results) {
    duration_s += result.duration_s;
    for (const auto& [cause, lost] : result.lost) {
      LostTime& sum = all[cause];
      sum.needed_s += lost.needed_s;
      sum.allowed_s += lost.allowed_s;
      sum.false_s += lost.false_s;
      all_s += lost.sum_s();
    }
  }
  std::vector<std::pair<std::string, LostTime>> causes(all.begin(), all.end());
  std::ranges::sort(causes, std::ranges::greater(),
                    [](const auto& cause) { return cause.second.sum_s(); });
  std::string rows;
  for (const auto& [cause, lost] : causes) {
    constexpr double kLeast = 0.01;
    if (lost.sum_s() < kLeast * all_s) continue;
    rows += fmt::format("| {} | {} | {:.0f} % | {:.0f} % | {:.0f} % | {:.0f} % |\n", policy.name,
                        cause, 100 * lost.sum_s() / duration_s, 100 * lost.needed_s / all_s,
                        100 * lost.allowed_s / all_s, 100 * lost.false_s / all_s);
  }
  return rows;
}

}  // namespace

std::string encounter_table(const std::vector<Policy>& policies,
                            const std::vector<std::vector<EncounterResult>>& results) {
  std::string table =
      "| supervised by | contacts while the arm moved | its greatest speed then [m/s] | contacts "
      "with an arm that stood | least distance while it moved | median of the least | least to "
      "table, floor and its own links | a cycle takes | it stands |\n"
      "| --- | --- | --- | --- | --- | --- | --- | --- | --- |\n";
  for (std::size_t i = 0; i < policies.size(); ++i) table += row(policies[i], results[i]);
  return table;
}

std::string census_table(const std::vector<Policy>& policies,
                         const std::vector<std::vector<EncounterResult>>& results) {
  std::string table =
      "| policy | cause | lost, of all time | of what the policy loses: needed | allowed | false "
      "|\n"
      "| --- | --- | ---: | ---: | ---: | ---: |\n";
  for (std::size_t i = 0; i < policies.size(); ++i) table += census_rows(policies[i], results[i]);
  return table;
}

std::string encounter_csv(const std::vector<Policy>& policies,
                          const std::vector<std::vector<EncounterResult>>& results) {
  std::string csv =
      "policy,seed,duration_s,phase_s,least_moving_m,contact_m_s,has_touched,stopped_share,"
      "least_known_m,reached,cause,needed\n";
  for (std::size_t i = 0; i < policies.size(); ++i) {
    for (const EncounterResult& r : results[i]) {
      csv += fmt::format("{},{},{:.3f},{:.4f},{:.5f},{:.5f},{:d},{:.4f},{:.5f},{},{},{:.4f}\n",
                         policies[i].name, r.seed, r.duration_s, r.phase_s, r.least_moving_m,
                         r.contact_m_s, r.has_touched, r.stopped_share, r.least_known_m, r.reached,
                         main_cause(r.lost), needed_share(r.lost));
    }
  }
  return csv;
}

}  // namespace berth::lab
