#pragma once

#include <initializer_list>
#include <nlohmann/json.hpp>
#include <utility>
#include <vector>

#include "lab/bench/statistics.hpp"

namespace berth::lab {

/// An object of named percentiles; null where nothing was measured.
inline nlohmann::ordered_json percentiles(
    const std::vector<double>& values,
    std::initializer_list<std::pair<const char*, double>> shares) {
  nlohmann::ordered_json out;
  for (const auto& [name, share] : shares) {
    const std::optional<double> value = percentile(values, share);
    out[name] = value ? nlohmann::ordered_json(*value) : nlohmann::ordered_json();
  }
  return out;
}

}  // namespace berth::lab
