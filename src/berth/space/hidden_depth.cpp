#include "berth/space/hidden_depth.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "berth/space/free_depth.hpp"

namespace berth {

void hide_behind_holes(const ObstacleImage& obstacles, const UnitImage& own, double detected_m,
                       const SpaceSettings& settings, DepthWindows& hidden) {
  const int behind = units_of(static_cast<float>(detected_m / 2 + settings.free_space_margin_m +
                                                 settings.surface_thickness_m));
  for (int v = 0; v < own.height(); ++v) {
    const PixelFate* const fate = obstacles.fate.row(v);
    constexpr auto kHole = static_cast<int>(PixelFate::hole);
    // Most rows have none.
    if (std::memchr(fate, kHole, static_cast<std::size_t>(own.width())) == nullptr) continue;
    const DepthUnits* const frees = own.row(v);
    DepthUnits* const from = hidden.levels[0].row(v);
    for (int u = 0; u < own.width(); ++u) {
      if (fate[u] != PixelFate::hole) continue;
      const int hides = std::min<int>(frees[u] + behind, kEndlessUnits);
      from[u] = std::min(from[u], static_cast<DepthUnits>(hides));
    }
  }
}

void build_environment_ceiling(DepthView environment_front_m, UnitImage& scratch,
                               DepthCeiling& out) {
  set_size(environment_front_m.width, environment_front_m.height, scratch);
  for (int v = 0; v < environment_front_m.height; ++v) {
    for (int u = 0; u < environment_front_m.width; ++u) {
      const float front_m = environment_front_m(u, v);
      const int left = kEndlessUnits - units_up(front_m);
      scratch(u, v) = std::isnan(front_m) ? DepthUnits{0} : static_cast<DepthUnits>(left);
    }
  }
  // The least of 3 x 3, and nothing in the outermost ring, as of what is free.
  find_free_depth(scratch, out.left);
  build_depth_windows(out.left);
}

}  // namespace berth
