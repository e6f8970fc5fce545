#include "lab/closed_loop/policies.hpp"

#include <fmt/format.h>

#include <stdexcept>

#include "lab/closed_loop/cell.hpp"

namespace berth::lab {
namespace {

SeparationSettings changed(void (*change)(SeparationSettings&)) {
  SeparationSettings settings = cell_separation();
  change(settings);
  return settings;
}

std::unique_ptr<Supervisor> monitor(std::vector<int> cameras,
                                    const SeparationSettings& settings = cell_separation(),
                                    ShownBy shown = ShownBy::along_path) {
  return std::make_unique<MonitorSupervisor>(Method::mesh, std::move(cameras), settings, shown);
}

std::unique_ptr<Supervisor> three(void (*change)(SeparationSettings&)) {
  return monitor({0, 1, 2}, changed(change));
}

constexpr double kContact_m_s = 0.25;
constexpr double kSlow_m_s = 0.25;

struct Row {
  Policy policy;
  std::unique_ptr<Supervisor> (*make)();
};

const std::vector<Row>& rows() {
  static const std::vector<Row> all = {
      {{"path", "**berth, three cameras, the defaults**"},
       [] {
         return monitor({0, 1, 2});
       }},
      {{"contact", "three cameras, a contact at 0.25 m/s is tolerable"},
       [] { return three([](auto& s) { s.contact_speed_m_s = kContact_m_s; }); }},
      {{"formula", "three cameras, as if the arm ran straight at what is nearest"},
       [] {
         return monitor({0, 1, 2}, cell_separation(), ShownBy::formula);
       }},
      {{"straight", "three cameras, the arm's way is not told: it goes straight on, and bends"},
       [] {
         return monitor({0, 1, 2}, cell_separation(), ShownBy::straight_on);
       }},
      {{"fine", "three cameras that detect 20 mm"},
       [] { return three([](auto& s) { s.detection_m = 0.02; }); }},
      {{"readings", "three cameras, unknown space ignored"},
       [] { return three([](auto& s) { s.unknown = UnknownPolicy::ignore; }); }},
      {{"two", "two cameras, the defaults"},
       [] {
         return monitor({1, 2});
       }},
      {{"one", "one camera, the defaults"}, [] { return monitor({0}); }},
      {{"evading", "three cameras, and the arm gives way to what comes near"},
       []() -> std::unique_ptr<Supervisor> {
         return std::make_unique<EvadingSupervisor>(Method::mesh, std::vector{0, 1, 2},
                                                    cell_separation());
       }},
      {{"exact", "one camera, the visible side alone (`exact`, what is not seen is ignored)"},
       []() -> std::unique_ptr<Supervisor> {
         return std::make_unique<MonitorSupervisor>(
             Method::exact, std::vector{0},
             changed([](auto& s) { s.not_seen = UnknownPolicy::ignore; }));
       }},
      {{"conforming", "a fixed zone as a safety scanner has to have it"},
       []() -> std::unique_ptr<Supervisor> {
         return std::make_unique<FixedZone>(conforming_zone_m(kArmFullSpeed_m_s));
       }},
      {{"conforming_two_steps", "the same in two steps: slow, 0.25 m/s, and stop"},
       []() -> std::unique_ptr<Supervisor> {
         return std::make_unique<FixedZone>(conforming_zone_m(kSlow_m_s),
                                            conforming_zone_m(kArmFullSpeed_m_s), kSlow_m_s);
       }},
      {{"zone", "*not conforming*: stop while anybody is within 1.5 m of the base"},
       []() -> std::unique_ptr<Supervisor> { return std::make_unique<FixedZone>(1.5); }},
      {{"none", "nobody: always at full speed"},
       []() -> std::unique_ptr<Supervisor> { return std::make_unique<NoSupervisor>(); }}};
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

std::unique_ptr<Supervisor> make_supervisor(const std::string& name) {
  for (const Row& row : rows()) {
    if (row.policy.name == name) return row.make();
  }
  throw std::invalid_argument(fmt::format("policy: \"{}\"; expected one that --help names", name));
}

}  // namespace berth::lab
