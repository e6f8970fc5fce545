#pragma once

#include <string>
#include <vector>

#include "lab/closed_loop/policies.hpp"
#include "lab/closed_loop/simulation.hpp"

namespace berth::lab {

/// A row of a Markdown table for each policy; results[i] are those of policies[i].
std::string encounter_table(const std::vector<Policy>& policies,
                            const std::vector<std::vector<EncounterResult>>& results);

/// What each policy's lost time was for, by the causes that lost a hundredth of it or more.
std::string census_table(const std::vector<Policy>& policies,
                         const std::vector<std::vector<EncounterResult>>& results);

/// One line for each encounter, with a header.
std::string encounter_csv(const std::vector<Policy>& policies,
                          const std::vector<std::vector<EncounterResult>>& results);

}  // namespace berth::lab
