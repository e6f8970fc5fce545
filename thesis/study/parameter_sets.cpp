#include "thesis/study/parameter_sets.hpp"

#include <fmt/format.h>

namespace berth::lab {
namespace {

/// Of the sets that vary all but 2L: berth's default range.
constexpr double kUsualLength_m = 2.0;

ImageDistanceSettings settings_with(double length_m) {
  ImageDistanceSettings settings;
  settings.range_m = length_m / 2;
  settings.mean_direction = false;
  return settings;
}

std::vector<ParameterSet> brute_force_sets(const SweepExtent& extent) {
  std::vector<ParameterSet> sets;
  for (const double length_m : extent.brute_force_lengths_m) {
    for (const SearchPattern pattern : kSearchPatterns) {
      ImageDistanceSettings settings = settings_with(length_m);
      settings.surveillance = {SurveillanceRegion::cube_projection, DepthInterval::gray_area,
                               pattern, Shrinking::none};
      sets.push_back({Part::brute_force, Method::brute_force, settings});
    }
  }
  return sets;
}

void add_radii(Part part, const ImageDistanceSettings& settings, const std::vector<int>& initial_px,
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

std::vector<ParameterSet> surveillance_length_sets(const SweepExtent& extent) {
  std::vector<ParameterSet> sets;
  for (const double length_m : extent.lengths_m) {
    for (const SearchPattern pattern : kSearchPatterns) {
      for (const int step : extent.equal_steps) {
        ImageDistanceSettings settings = settings_with(length_m);
        settings.surveillance.search_pattern = pattern;
        settings.lattice.step_x = settings.lattice.step_y = step;
        add_radii(Part::surveillance_length, settings, extent.few_initial_radii_px,
                  extent.few_final_radii_px, sets);
      }
    }
  }
  return sets;
}

std::vector<ParameterSet> step_and_radius_sets(Part part, const SweepExtent& extent,
                                               const SurveillanceSettings& surveillance) {
  std::vector<ParameterSet> sets;
  for (const int step_x : extent.steps) {
    for (const int step_y : extent.steps) {
      if (step_y > step_x) continue;
      ImageDistanceSettings settings = settings_with(kUsualLength_m);
      settings.surveillance = surveillance;
      settings.lattice.step_x = step_x;
      settings.lattice.step_y = step_y;
      add_radii(part, settings, extent.initial_radii_px, extent.final_radii_px, sets);
    }
  }
  return sets;
}

std::vector<ParameterSet> exact_sets(const SweepExtent& extent) {
  std::vector<ParameterSet> sets;
  for (const double length_m : extent.lengths_m) {
    sets.push_back({Part::exact, Method::exact, settings_with(length_m)});
  }
  return sets;
}

ParameterSet gl_set(Part part, Method method, int step) {
  ParameterSet set{part, method, settings_with(kUsualLength_m)};
  set.settings.lattice.step_x = set.settings.lattice.step_y = step;
  return set;
}

std::vector<ParameterSet> gl_hybrid_sets(const SweepExtent& extent) {
  std::vector<ParameterSet> sets;
  for (const int step : extent.gl_steps) {
    for (const int first_px : extent.gl_initial_radii_px) {
      for (const int last_px : extent.gl_final_radii_px) {
        sets.push_back(gl_set(Part::gl_hybrid, Method::gl_hybrid, step));
        sets.back().settings.lattice.initial_grid_radius_px = first_px;
        sets.back().settings.lattice.final_grid_radius_px = last_px;
      }
    }
  }
  return sets;
}

std::vector<ParameterSet> gl_lattice_sets(const SweepExtent& extent) {
  std::vector<ParameterSet> sets;
  for (const int step : extent.gl_steps) {
    for (const int first_px : extent.gl_tiles_px) {
      for (const int last_px : extent.gl_final_radii_px) {
        sets.push_back(gl_set(Part::gl_lattice, Method::gl_lattice, step));
        sets.back().settings.lattice.tile_px = first_px;
        sets.back().settings.lattice.final_grid_radius_px = last_px;
      }
    }
  }
  return sets;
}

/// Region, shrinking, pattern.
std::string surveillance_columns(const ParameterSet& set) {
  if (set.method != Method::brute_force && set.method != Method::lattice) return ",,";
  const SurveillanceSettings& watched = set.settings.surveillance;
  return fmt::format("{},{},{}",
                     name_of(watched.region.value_or(SurveillanceRegion::cube_projection)),
                     name_of(watched.shrinking), name_of(watched.search_pattern));
}

/// Steps, radii, tile.
std::string lattice_columns(const ParameterSet& set) {
  const LatticeSettings& lattice = set.settings.lattice;
  if (set.method == Method::lattice || set.method == Method::gl_hybrid) {
    return fmt::format("{},{},{},{},", lattice.step_x, lattice.step_y,
                       lattice.initial_grid_radius_px, lattice.final_grid_radius_px);
  }
  if (set.method == Method::gl_lattice) {
    return fmt::format("{},{},,{},{}", lattice.step_x, lattice.step_y, lattice.final_grid_radius_px,
                       lattice.tile_px);
  }
  return ",,,,";
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
    case Part::gl_hybrid:
      return "gl_hybrid";
    case Part::gl_lattice:
      return "gl_lattice";
    case Part::gl_exact:
      return "gl_exact";
  }
  return {};
}

bool runs_on_opengl(Part part) {
  return part == Part::gl_hybrid || part == Part::gl_lattice || part == Part::gl_exact;
}

SweepExtent full_extent() {
  return {
      .brute_force_lengths_m = {0.2, 0.4, 0.8, 1.2, 1.6, 2.0, 3.0, 4.0, 6.0, 8.0},
      .lengths_m = {0.2, 0.4, 0.6, 0.8, 1.2, 1.6, 2.0, 3.0},
      .equal_steps = {1, 2, 3, 4, 8, 16, 24, 32},
      .few_initial_radii_px = {40, 100},
      .few_final_radii_px = {1, 2, 3},
      .steps = {1, 2, 3, 4, 6, 8, 12, 16, 24, 32},
      .initial_radii_px = {10, 20, 30, 40, 50, 60, 70, 80, 90, 100},
      .final_radii_px = {1, 2, 3, 4},
      .gl_steps = {1, 2, 4, 8, 16, 24, 32, 48, 64},
      .gl_initial_radii_px = {10, 20, 40, 60, 80, 100},
      .gl_final_radii_px = {1, 2, 3},
      .gl_tiles_px = {8, 16, 32},
  };
}

SweepExtent quick_extent() {
  return {
      .brute_force_lengths_m = {0.4, 2.0, 6.0, 8.0},
      .lengths_m = {0.4, 0.8, 2.0, 3.0},
      .equal_steps = {1, 4, 8, 32},
      .few_initial_radii_px = {40},
      .few_final_radii_px = {1, 3},
      .steps = {1, 4, 16, 32},
      .initial_radii_px = {10, 40, 100},
      .final_radii_px = {1, 3},
      .gl_steps = {4, 16, 32, 64},
      .gl_initial_radii_px = {10, 40, 100},
      .gl_final_radii_px = {2},
      .gl_tiles_px = {16, 32},
  };
}

std::vector<ParameterSet> sets_of(Part part, const SweepExtent& extent) {
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
    case Part::gl_hybrid:
      return gl_hybrid_sets(extent);
    case Part::gl_lattice:
      return gl_lattice_sets(extent);
    case Part::gl_exact:
      return {{Part::gl_exact, Method::gl_exact, settings_with(kUsualLength_m)}};
  }
  return {};
}

std::string columns_of(const ParameterSet& set) {
  return fmt::format("{},{},{},{},{}", name_of(set.part), name_of(set.method),
                     2 * set.settings.range_m, surveillance_columns(set), lattice_columns(set));
}

}  // namespace berth::lab
