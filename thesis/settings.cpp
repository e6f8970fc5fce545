#include "thesis/settings.hpp"

#include <string>

namespace berth {

void validate(const ImageSettings& settings) {
  visit_settings(settings, SettingCheck{"evaluation"});
  const LatticeSettings& lattice = settings.lattice;
  if (lattice.final_grid_radius_px <= lattice.initial_grid_radius_px) return;
  throw_bad_setting("evaluation", "final_grid_radius_px", lattice.final_grid_radius_px,
                    "a whole number from 1 to " + std::to_string(lattice.initial_grid_radius_px) +
                        ", the initial_grid_radius_px");
}

void validate(const ImageDistanceSettings& settings) {
  validate(static_cast<const DistanceSettings&>(settings));
  validate(static_cast<const ImageSettings&>(settings));
}

}  // namespace berth
