#include "berth/distance/settings.hpp"

#include <cmath>
#include <stdexcept>
#include <string>

namespace berth {

namespace {

void require(bool holds, const char* key, double value, const char* expected) {
  if (holds) return;
  throw std::invalid_argument(std::string(key) + " is " + std::to_string(value) + ", expected " +
                              expected);
}

void require_pixels(const char* key, int value, int most_px = kMaxLatticePx,
                    const char* of_what = "") {
  if (value >= 1 && value <= most_px) return;
  throw std::invalid_argument(std::string(key) + " is " + std::to_string(value) +
                              ", expected a whole number from 1 to " + std::to_string(most_px) +
                              of_what);
}

void validate(const LatticeSettings& lattice) {
  require_pixels("step_x", lattice.step_x);
  require_pixels("step_y", lattice.step_y);
  require_pixels("initial_grid_radius_px", lattice.initial_grid_radius_px);
  require_pixels("final_grid_radius_px", lattice.final_grid_radius_px,
                 lattice.initial_grid_radius_px, ", the initial_grid_radius_px");
  require_pixels("tile_px", lattice.tile_px, kMaxTilePx);
}

}  // namespace

void validate(const DistanceSettings& settings) {
  require(std::isfinite(settings.range_m) && settings.range_m > 0, "range_m", settings.range_m,
          "a finite number above 0");
  require(std::isfinite(settings.tolerance_m) && settings.tolerance_m >= 0, "tolerance_m",
          settings.tolerance_m, "a finite number of at least 0");
  const double deadline_us = settings.deadline_us.value_or(0);
  require(deadline_us >= 0, "deadline_us", deadline_us, "a number of at least 0");
  validate(settings.lattice);
}

}  // namespace berth
