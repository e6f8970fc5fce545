// The same settings against known truth: drawn scenes, and robots drawn into real images.
#pragma once

#include <filesystem>
#include <vector>

#include "lab/filter/filter_grid.hpp"
#include "lab/trust/trial.hpp"

namespace berth::lab {

/// Prints a Markdown table for each kind of sensor error, `scenes` drawn scenes each.
void print_drawn_truth(const FilterGrid& grid, const std::vector<TrialRobot>& robots, int scenes);

/// Prints one for `scenes` tries of robots in the real images of the folder.
void print_real_images(const FilterGrid& grid, const std::vector<TrialRobot>& robots,
                       const std::filesystem::path& folder, int scenes);

}  // namespace berth::lab
