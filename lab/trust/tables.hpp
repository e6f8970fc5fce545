// What the trials say, as Markdown. Lengths are in mm.
#pragma once

#include <string>
#include <vector>

#include "lab/trust/trial.hpp"

namespace berth::lab {

/// A row for each condition, a table for each Condition::table.
std::string condition_tables(const std::vector<Trial>& trials,
                             const std::vector<Condition>& conditions);

/// For one condition: how the camera sees the nearest point of the obstacles.
std::string sight_table(const std::vector<Trial>& trials, std::size_t condition);

/// For one condition: how near the distances come to sim::max_overestimate_m, by robot and by
/// resolution.
std::string bound_table(const std::vector<Trial>& trials, std::size_t condition);

/// For one condition: the `count` links with the greatest overestimates of what is seen and
/// covered.
std::string worst_table(const std::vector<Trial>& trials, std::size_t condition, int count);

}  // namespace berth::lab
