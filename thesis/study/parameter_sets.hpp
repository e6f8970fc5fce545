// The parameters that are varied in the thesis's experiments (Hirt 3.2).
#pragma once

#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "thesis/evaluate.hpp"

namespace berth::lab {

/// Each enumerator is its own name, that of a part of the study.
enum class Part {
  brute_force,          ///< figure 3.5
  surveillance_length,  ///< figures 3.6 to 3.8 and 3.12: 2L, steps and patterns
  parameters,           ///< figures 3.9 to 3.11 and 3.17 to 3.19: the 2200 sets, at one 2L
  every_pair,           ///< the same without a region that shrinks, for the worst case of 3.19
  exact,                ///< berth's own method, beside them
  gl_hybrid,            ///< figures 3.13 to 3.19: "CPU rasterization"; steps and radii
  gl_lattice,           ///< the same: "GPU rasterization"; steps and tiles
  gl_exact,             ///< berth's own method on OpenGL, beside them
};

inline constexpr std::array kParts = {
    Part::brute_force, Part::surveillance_length, Part::parameters, Part::every_pair,
    Part::exact,       Part::gl_hybrid,           Part::gl_lattice, Part::gl_exact};

std::string_view name_of(Part part);
bool runs_on_opengl(Part part);

/// A method with its settings, to be measured on a scene.
struct ParameterSet {
  Part part;
  Method method;
  ImageDistanceSettings settings;
};

/// How many values each parameter takes.
struct SweepExtent {
  /// 2L, in metres.
  std::vector<double> brute_force_lengths_m;
  std::vector<double> lengths_m;
  /// step_x = step_y while 2L varies.
  std::vector<int> equal_steps;
  std::vector<int> few_initial_radii_px;
  std::vector<int> few_final_radii_px;
  /// All pairs with step_x >= step_y: an image is wider than it is high.
  std::vector<int> steps;
  std::vector<int> initial_radii_px;
  std::vector<int> final_radii_px;
  /// step_x = step_y on OpenGL, where the thesis goes beyond 32.
  std::vector<int> gl_steps;
  std::vector<int> gl_initial_radii_px;
  std::vector<int> gl_final_radii_px;
  std::vector<int> gl_tiles_px;
};

/// What the thesis varied; its 2200 parameter sets.
SweepExtent full_extent();
/// A few values of each, with the least and the greatest among them.
SweepExtent quick_extent();

std::vector<ParameterSet> sets_of(Part part, const SweepExtent& extent);

/// The names of the columns that columns_of() fills.
inline constexpr std::string_view kSetColumns =
    "part,method,surveillance_length_m,region,shrinking,search_pattern,step_x,step_y,"
    "initial_grid_radius_px,final_grid_radius_px,initial_tile_px";
/// A column is empty where the method does not have the parameter.
std::string columns_of(const ParameterSet& set);

}  // namespace berth::lab
