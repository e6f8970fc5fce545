#pragma once

#include <string>
#include <vector>

#include "lab/trust/trial_robots.hpp"

namespace berth::lab {

/// Prints how well what is carried is found, as a Markdown table: five robots whose names hold
/// `only`, three kinds of things and none, `seeds` of each, 5 and 10 poses, one and three cameras.
void measure_attached(const std::vector<TrialRobot>& robots, const std::string& only, int seeds,
                      bool prints_each);

/// Prints what is found of robots that carry nothing beside others that move, as measure_attached.
void measure_company(const std::vector<TrialRobot>& robots, const std::string& only, int seeds);

}  // namespace berth::lab
