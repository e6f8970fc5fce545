#include "berth/separation/settings.hpp"

#include <fmt/format.h>

namespace berth {
namespace {

void validate_row(const StoppingRow& row, const StoppingRow& before, std::size_t number) {
  const auto check = [&](std::string_view name, double value, double least, bool above) {
    const Domain domain{.least = least, .is_open = above};
    if (domain.holds(value)) return;
    throw_bad_setting(fmt::format("separation.stopping[{}]", number), name, value,
                      domain.text(false));
  };
  check("speed_m_s", row.speed_m_s, before.speed_m_s, true);
  check("time_s", row.time_s, before.time_s, false);
  check("distance_m", row.distance_m, before.distance_m, false);
}

}  // namespace

void validate(const SeparationSettings& settings) {
  visit_settings(settings, SettingCheck{"separation"});
  StoppingRow before;
  for (std::size_t i = 0; i < settings.stopping.size(); ++i) {
    validate_row(settings.stopping[i], before, i);
    before = settings.stopping[i];
  }
}

}  // namespace berth
