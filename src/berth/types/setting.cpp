#include "berth/types/setting.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>
#include <stdexcept>

namespace berth {

bool Domain::holds(double value) const {
  if (has_off && value == 0) return true;
  if (std::isinf(value)) return may_be_infinite && value > 0;
  return (is_open ? value > least : value >= least) && value <= most;
}

std::string Domain::text(bool is_whole) const {
  const char* what = is_whole ? "a whole number" : may_be_infinite ? "a number" : "a finite number";
  std::string text = fmt::format("{} {} {}", what, is_open ? "above" : "of at least", least);
  if (std::isfinite(most) && is_open) text += fmt::format(" up to {}", most);
  if (std::isfinite(most) && !is_open) text = fmt::format("{} from {} to {}", what, least, most);
  return has_off ? text + ", or 0 (off)" : text;
}

void throw_bad_setting(std::string_view group, std::string_view name, double value,
                       std::string_view expected) {
  throw std::invalid_argument(fmt::format("{}.{}: {}; expected {}", group, name, value, expected));
}

std::string SettingRef::expected() const {
  if (kind == SettingKind::flag) return "true or false";
  if (kind == SettingKind::choice) return fmt::format("one of {}", fmt::join(choices, ", "));
  return domain.text(kind == SettingKind::whole);
}

SettingValue SettingRef::choice(std::string_view text) const {
  const auto found = std::ranges::find(choices, text);
  if (found != choices.end()) return *found;
  throw std::invalid_argument(fmt::format("\"{}\"; expected {}", text, expected()));
}

}  // namespace berth
