#include "berth/watch/watch_settings.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

namespace berth {
namespace {

/// NaN where there is none.
double greatest(std::span<const double> values) {
  double most = std::numeric_limits<double>::quiet_NaN();
  for (const double value : values) most = std::fmax(most, value);
  return most;
}

}  // namespace

void validate(const WatchSettings& settings) {
  visit_settings(settings, SettingCheck{"watch"});
  // With half of them or fewer, the same frames could say both.
  if (settings.agreeing_frames > settings.frames ||
      2 * settings.agreeing_frames <= settings.frames) {
    throw_bad_setting("watch", "agreeing_frames", settings.agreeing_frames,
                      "more than half of watch.frames, " + std::to_string(settings.frames) +
                          ", and no more than all");
  }
}

WatchSettings learned_limits(std::span<const double> seen_through,
                             std::span<const double> displacement_m) {
  WatchSettings settings;
  const double most_seen_through = greatest(seen_through);
  if (!std::isnan(most_seen_through)) {
    settings.max_seen_through = std::clamp(2 * most_seen_through + 0.01, 0.03, 1.0);
  }
  const double most_m = greatest(displacement_m);
  if (!std::isnan(most_m)) settings.max_displacement_m = std::max(1.5 * most_m, 0.008);
  return settings;
}

}  // namespace berth
