#include "study/parameter_sets.hpp"

#include <fmt/format.h>

namespace berth::study {
namespace {

/// Of the sets that vary all but 2L: berth's default range.
constexpr double kUsualLength_m = 2.0;

DistanceSettings settings_with(double length_m) {
  DistanceSettings settings;
  settings.range_m = length_m / 2;
  settings.mean_direction = false;
  return settings;
}

std::vector<ParameterSet> brute_force_sets(const Extent& extent) {
  std::vector<ParameterSet> sets;
  for (const double length_m : extent.brute_force_lengths_m) {
    for (const SearchPattern pattern : kSearchPatterns) {
      DistanceSettings settings = settings_with(length_m);
      settings.surveillance = {SurveillanceRegion::cube_projection, DepthInterval::gray_area,
                               pattern, Shrinking::none};
      sets.push_back({Part::brute_force, Method::brute_force, settings});
    }
  }
  return sets;
}

void add_radii(Part part, const DistanceSettings& settings, const std::vector<int>& initial_px,
               const std::vector<int>& final_px, std::vector<ParameterSet>& sets) {
  for (const int first_px : initial_px) {
    for (const int last_px : final_px) {
      ParameterSet set{part, Method::lattice, settings};
      set.settings.lattice.initial_grid_radius_px = first_px;
      set.settings.lattice.final_grid_radius_px = last_px;
      sets.push_back(set);
    }
  }
}

std::vector<ParameterSet> surveillance_length_sets(const Extent& extent) {
  std::vector<ParameterSet> sets;
  for (const double length_m : extent.lengths_m) {
    for (const SearchPattern pattern : kSearchPatterns) {
      for (const int step : extent.equal_steps) {
        DistanceSettings settings = settings_with(length_m);
        settings.surveillance.search_pattern = pattern;
        settings.lattice.step_x = settings.lattice.step_y = step;
        add_radii(Part::surveillance_length, settings, extent.few_initial_radii_px,
                  extent.few_final_radii_px, sets);
      }
    }
  }
  return sets;
}

std::vector<ParameterSet> step_and_radius_sets(Part part, const Extent& extent,
                                               const SurveillanceSettings& surveillance) {
  std::vector<ParameterSet> sets;
  for (const int step_x : extent.steps) {
    for (const int step_y : extent.steps) {
      if (step_y > step_x) continue;
      DistanceSettings settings = settings_with(kUsualLength_m);
      settings.surveillance = surveillance;
      settings.lattice.step_x = step_x;
      settings.lattice.step_y = step_y;
      add_radii(part, settings, extent.initial_radii_px, extent.final_radii_px, sets);
    }
  }
  return sets;
}

std::vector<ParameterSet> exact_sets(const Extent& extent) {
  std::vector<ParameterSet> sets;
  for (const double length_m : extent.lengths_m) {
    sets.push_back({Part::exact, Method::exact, settings_with(length_m)});
  }
  return sets;
}

SurveillanceRegion region_of(const ParameterSet& set) {
  return set.settings.surveillance.region.value_or(SurveillanceRegion::cube_projection);
}

}  // namespace

std::string_view name_of(Part part) {
  switch (part) {
    case Part::brute_force:
      return "brute_force";
    case Part::surveillance_length:
      return "surveillance_length";
    case Part::parameters:
      return "parameters";
    case Part::every_pair:
      return "every_pair";
    case Part::exact:
      return "exact";
  }
  return {};
}

Extent full_extent() {
  return {
      .brute_force_lengths_m = {0.2, 0.4, 0.8, 1.2, 1.6, 2.0, 3.0, 4.0, 6.0, 8.0},
      .lengths_m = {0.2, 0.4, 0.6, 0.8, 1.2, 1.6, 2.0, 3.0},
      .equal_steps = {1, 2, 3, 4, 8, 16, 24, 32},
      .few_initial_radii_px = {40, 100},
      .few_final_radii_px = {1, 2, 3},
      .steps = {1, 2, 3, 4, 6, 8, 12, 16, 24, 32},
      .initial_radii_px = {10, 20, 30, 40, 50, 60, 70, 80, 90, 100},
      .final_radii_px = {1, 2, 3, 4},
  };
}

Extent quick_extent() {
  return {
      .brute_force_lengths_m = {0.4, 2.0, 6.0, 8.0},
      .lengths_m = {0.4, 0.8, 2.0, 3.0},
      .equal_steps = {1, 4, 8, 32},
      .few_initial_radii_px = {40},
      .few_final_radii_px = {1, 3},
      .steps = {1, 4, 16, 32},
      .initial_radii_px = {10, 40, 100},
      .final_radii_px = {1, 3},
  };
}

std::vector<ParameterSet> sets_of(Part part, const Extent& extent) {
  switch (part) {
    case Part::brute_force:
      return brute_force_sets(extent);
    case Part::surveillance_length:
      return surveillance_length_sets(extent);
    case Part::parameters:
      return step_and_radius_sets(part, extent, {});
    case Part::every_pair:
      return step_and_radius_sets(
          part, extent, {.region = SurveillanceRegion::image, .shrinking = Shrinking::none});
    case Part::exact:
      return exact_sets(extent);
  }
  return {};
}

std::string columns_of(const ParameterSet& set) {
  std::string text =
      fmt::format("{},{},{}", name_of(set.part), name_of(set.method), 2 * set.settings.range_m);
  if (set.method == Method::exact) return text + ",,,,,,,";
  const SurveillanceSettings& watched = set.settings.surveillance;
  text += fmt::format(",{},{},{}", name_of(region_of(set)), name_of(watched.shrinking),
                      name_of(watched.search_pattern));
  if (set.method != Method::lattice) return text + ",,,,";
  const LatticeSettings& lattice = set.settings.lattice;
  return text + fmt::format(",{},{},{},{}", lattice.step_x, lattice.step_y,
                            lattice.initial_grid_radius_px, lattice.final_grid_radius_px);
}

}  // namespace berth::study
