#include "berth/types/setting_ref.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <stdexcept>

namespace berth {

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
