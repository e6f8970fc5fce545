#include "lab/closed_loop/policies.hpp"

#include <fmt/format.h>

#include <stdexcept>

#include "lab/closed_loop/cell.hpp"
#include "lab/closed_loop/goals.hpp"

namespace berth::lab {
namespace {

using Made = std::unique_ptr<Supervisor>;

class AssumingSupervisor : public MonitorSupervisor {
 public:
  AssumingSupervisor(std::vector<int> cameras, const SeparationSettings& settings, ShownBy shown)
      : MonitorSupervisor(std::move(cameras), settings, shown),
        assumption_{settings, shown != ShownBy::formula} {}
  std::optional<Assumption> assumption() const override { return assumption_; }

 private:
  Assumption assumption_;
};

Made monitor(std::vector<int> cameras, const SeparationSettings& settings,
             ShownBy shown = ShownBy::along_path) {
  return std::make_unique<AssumingSupervisor>(std::move(cameras), settings, shown);
}

/// As makers of certified cameras have it: for a reaching arm, and C for what they detect.
Made device(double hz, double intrusion_m, ShownBy shown) {
  SeparationSettings settings = cell_separation(hz);
  settings.human_speed_m_s = 2.0;
  settings.intrusion_m = intrusion_m;
  return monitor({0, 1, 2}, settings, shown);
}

Made three(SeparationSettings settings, void (*change)(SeparationSettings&)) {
  change(settings);
  return monitor({0, 1, 2}, settings);
}

constexpr double kContact_m_s = 0.25;
constexpr double kSlow_m_s = 0.25;

struct Row {
  Policy policy;
  Made (*make)(double request_hz);
};

const std::vector<Row>& rows() {
  static const std::vector<Row> all = {
      {{"path", "**berth, three cameras, the defaults**"},
       [](double hz) {
         return monitor({0, 1, 2}, cell_separation(hz));
       }},
      {{"contact", "three cameras, a contact at 0.25 m/s is tolerable"},
       [](double hz) {
         return three(cell_separation(hz), [](auto& s) { s.contact_speed_m_s = kContact_m_s; });
       }},
      {{"formula", "three cameras, as if the arm ran straight at what is nearest"},
       [](double hz) {
         return monitor({0, 1, 2}, cell_separation(hz), ShownBy::formula);
       }},
      {{"path_160", "v_h = 2.0 m/s and C = 160 mm, as of a certified camera that detects hands"},
       [](double hz) { return device(hz, 0.16, ShownBy::along_path); }},
      {{"formula_160", "the same by the formula"},
       [](double hz) { return device(hz, 0.16, ShownBy::formula); }},
      {{"path_300", "v_h = 2.0 m/s and C = 300 mm, of one that detects arms"},
       [](double hz) { return device(hz, 0.3, ShownBy::along_path); }},
      {{"formula_300", "the same by the formula"},
       [](double hz) { return device(hz, 0.3, ShownBy::formula); }},
      {{"straight", "three cameras, the arm's way is not told: it goes straight on, and bends"},
       [](double hz) {
         return monitor({0, 1, 2}, cell_separation(hz), ShownBy::straight_on);
       }},
      {{"fine", "three cameras that detect 14 mm"},
       [](double hz) {
         return monitor({0, 1, 2}, cell_separation(hz, 0.014));
       }},
      {{"coarse", "three cameras that detect 40 mm"},
       [](double hz) {
         return monitor({0, 1, 2}, cell_separation(hz, 0.04));
       }},
      {{"readings", "three cameras, unknown space ignored"},
       [](double hz) {
         return three(cell_separation(hz), [](auto& s) { s.unknown = UnknownPolicy::ignore; });
       }},
      {{"two", "two cameras, the defaults"},
       [](double hz) {
         return monitor({1, 2}, cell_separation(hz));
       }},
      {{"one", "one camera, the defaults"},
       [](double hz) { return monitor({0}, cell_separation(hz)); }},
      {{"filter", "three cameras, an arm with goals, which takes those that are free"},
       [](double hz) -> Made {
         return std::make_unique<GoalSupervisor>(std::vector{0, 1, 2}, cell_separation(hz), hz);
       }},
      {{"conforming", "a fixed zone as a safety scanner has to have it"},
       [](double) -> Made {
         return std::make_unique<FixedZone>(conforming_zone_m(kArmFullSpeed_m_s));
       }},
      {{"conforming_two_steps", "the same in two steps: slow, 0.25 m/s, and stop"},
       [](double) -> Made {
         return std::make_unique<FixedZone>(conforming_zone_m(kSlow_m_s),
                                            conforming_zone_m(kArmFullSpeed_m_s), kSlow_m_s);
       }},
      {{"zone", "*not conforming*: stop while anybody is within 1.5 m of the base"},
       [](double) -> Made { return std::make_unique<FixedZone>(1.5); }},
      {{"none", "nobody: always at full speed"},
       [](double) -> Made { return std::make_unique<NoSupervisor>(); }}};
  return all;
}

}  // namespace

const std::vector<Policy>& all_policies() {
  static const std::vector<Policy> policies = [] {
    std::vector<Policy> all;
    for (const Row& row : rows()) all.push_back(row.policy);
    return all;
  }();
  return policies;
}

std::unique_ptr<Supervisor> make_supervisor(const std::string& name, double request_hz) {
  for (const Row& row : rows()) {
    if (row.policy.name == name) return row.make(request_hz);
  }
  throw std::invalid_argument(fmt::format("policy: \"{}\"; expected one that --help names", name));
}

}  // namespace berth::lab
