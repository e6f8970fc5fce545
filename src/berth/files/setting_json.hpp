// Inside berth only: the value of a setting as JSON.
#pragma once

#include <nlohmann/json.hpp>
#include <type_traits>

#include "berth/types/setting.hpp"

namespace berth {

/// Null where it is not set; `number` makes JSON of a double, which may be infinite.
template <class Number>
nlohmann::ordered_json setting_json(const SettingValue& value, const Number& number) {
  return std::visit(
      [&](const auto& one) -> nlohmann::ordered_json {
        using T = std::decay_t<decltype(one)>;
        if constexpr (std::is_same_v<T, std::monostate>) {
          return nullptr;
        } else if constexpr (std::is_same_v<T, double>) {
          return number(one);
        } else {
          return one;
        }
      },
      value);
}

}  // namespace berth
