#include "lab/closed_loop/policies.hpp"

#include <fmt/format.h>

#include <stdexcept>

#include "lab/closed_loop/cell.hpp"

namespace berth::lab {
namespace {

/// What one camera can be asked for: it sees less than enough of some link in any pose.
SeparationSettings visible_side_alone() {
  SeparationSettings settings = cell_separation();
  settings.not_seen = UnknownPolicy::ignore;
  return settings;
}

std::unique_ptr<Supervisor> monitor(Method method, std::vector<int> cameras,
                                    const SeparationSettings& settings = cell_separation()) {
  return std::make_unique<MonitorSupervisor>(method, std::move(cameras), settings);
}

SeparationSettings readings_alone() {
  SeparationSettings settings = cell_separation();
  settings.unknown = UnknownPolicy::ignore;
  return settings;
}

SeparationSettings rejected_readings() {
  SeparationSettings settings = cell_separation();
  settings.rejected = UnknownPolicy::assume_range;
  return settings;
}

SeparationSettings directed() {
  SeparationSettings settings = cell_separation();
  settings.directed_speed = true;
  return settings;
}

}  // namespace

const std::vector<Policy>& all_policies() {
  static const std::vector<Policy> policies = {
      {"none", "no monitor: always at full speed"},
      {"zone", "a fixed zone: stop while anybody is within 1.5 m of the base"},
      {"three", "berth, three cameras, the defaults"},
      {"two", "berth, two cameras, the defaults"},
      {"one", "berth, one camera, the defaults"},
      {"readings", "three cameras, unknown space ignored"},
      {"rejected", "three cameras, readings that were dropped as rejected count too"},
      {"directed", "three cameras, only the speed towards the closest obstacle"},
      {"evading", "three cameras, and the arm gives way to what comes near"},
      {"exact", "one camera, the visible side alone: method exact, what is not seen is ignored"}};
  return policies;
}

std::unique_ptr<Supervisor> make_supervisor(const std::string& name) {
  if (name == "none") return std::make_unique<NoSupervisor>();
  if (name == "zone") return std::make_unique<FixedZone>(1.5);
  if (name == "three") return monitor(Method::mesh, {0, 1, 2});
  if (name == "two") return monitor(Method::mesh, {1, 2});
  if (name == "one") return monitor(Method::mesh, {0});
  if (name == "readings") return monitor(Method::mesh, {0, 1, 2}, readings_alone());
  if (name == "rejected") return monitor(Method::mesh, {0, 1, 2}, rejected_readings());
  if (name == "directed") return monitor(Method::mesh, {0, 1, 2}, directed());
  if (name == "evading") {
    return std::make_unique<EvadingSupervisor>(Method::mesh, std::vector{0, 1, 2},
                                               cell_separation());
  }
  if (name == "exact") return monitor(Method::exact, {0}, visible_side_alone());
  throw std::invalid_argument(fmt::format("policy: \"{}\"; expected one that --help names", name));
}

}  // namespace berth::lab
