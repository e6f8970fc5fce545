// Which settings of the self filter are measured: each with each.
#pragma once

#include <string>
#include <vector>

#include "berth/self_filter/settings.hpp"
#include "berth/sensor/settings.hpp"

namespace berth::lab {

/// One point of the grid.
struct FilterChoice {
  SelfFilterSettings filter;
  SensorSettings sensor;
  /// The values of those axes that have more than one, as cells of a Markdown table.
  std::string cells;
};

/// The values of each setting that are tried; an empty list means the default alone.
struct FilterGrid {
  std::vector<double> tolerance_m;
  std::vector<double> padding_m;
  std::vector<double> padding_depth_m;
  std::vector<double> surface_tolerance_m;
  std::vector<double> flying_patch_radius_m;
  std::vector<int> speckle_px;

  /// The heading's cells of FilterChoice::cells.
  std::string heading() const;
  /// In the order of the axes, the last one fastest.
  std::vector<FilterChoice> choices() const;
};

}  // namespace berth::lab
