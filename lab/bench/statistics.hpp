#pragma once

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

namespace berth::lab {

/// The least value that this share (0 to 1) of the values does not exceed; nothing without a value.
inline std::optional<double> percentile(std::vector<double> values, double share) {
  if (values.empty()) return std::nullopt;
  const auto rank = std::ceil(share * static_cast<double>(values.size()));
  const auto nth =
      values.begin() + std::max<std::ptrdiff_t>(0, static_cast<std::ptrdiff_t>(rank) - 1);
  std::nth_element(values.begin(), nth, values.end());
  return *nth;
}

inline std::optional<double> median(std::vector<double> values) {
  return percentile(std::move(values), 0.5);
}

}  // namespace berth::lab
