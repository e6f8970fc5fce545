#include "berth/distance/settings.hpp"

#include <string>

namespace berth {

void validate(const DistanceSettings& settings) {
  visit_settings(settings, SettingCheck{"evaluation"});
  const LatticeSettings& lattice = settings.lattice;
  if (lattice.final_grid_radius_px <= lattice.initial_grid_radius_px) return;
  throw_bad_setting("evaluation", "final_grid_radius_px", lattice.final_grid_radius_px,
                    "a whole number from 1 to " + std::to_string(lattice.initial_grid_radius_px) +
                        ", the initial_grid_radius_px");
}

}  // namespace berth
