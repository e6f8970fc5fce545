#include "lab/filter/filter_grid.hpp"

#include <fmt/format.h>

namespace berth::lab {
namespace {

/// Each choice once for each value; `set` puts a value into a choice.
template <class T, class Set>
void cross(const std::vector<T>& values, Set set, std::vector<FilterChoice>& choices) {
  if (values.empty()) return;
  std::vector<FilterChoice> crossed;
  for (const FilterChoice& choice : choices) {
    for (const T& value : values) {
      crossed.push_back(choice);
      set(crossed.back()) = value;
      if (values.size() > 1) crossed.back().cells += fmt::format("| {} ", value);
    }
  }
  choices = std::move(crossed);
}

template <class T>
void name(const std::vector<T>& values, const char* key, std::string& heading) {
  if (values.size() > 1) heading += fmt::format("| {} ", key);
}

}  // namespace

std::string FilterGrid::heading() const {
  std::string heading;
  name(tolerance_m, "tolerance_m", heading);
  name(padding_m, "padding_m", heading);
  name(padding_depth_m, "padding_depth_m", heading);
  name(surface_tolerance_m, "surface_tolerance_m", heading);
  name(flying_patch_radius_m, "flying_patch_radius_m", heading);
  name(speckle_px, "speckle_px", heading);
  return heading;
}

std::vector<FilterChoice> FilterGrid::choices() const {
  std::vector<FilterChoice> all(1);
  cross(
      tolerance_m, [](FilterChoice & c) -> auto& { return c.filter.tolerance_m; }, all);
  cross(
      padding_m, [](FilterChoice & c) -> auto& { return c.filter.padding_m; }, all);
  cross(
      padding_depth_m, [](FilterChoice & c) -> auto& { return c.filter.padding_depth_m; }, all);
  cross(
      surface_tolerance_m, [](FilterChoice & c) -> auto& { return c.filter.surface_tolerance_m; },
      all);
  cross(
      flying_patch_radius_m,
      [](FilterChoice & c) -> auto& { return c.filter.flying_patch_radius_m; }, all);
  cross(
      speckle_px, [](FilterChoice & c) -> auto& { return c.sensor.speckle_px; }, all);
  return all;
}

}  // namespace berth::lab
