// What the whole-robot trials say, as Markdown. Lengths are in mm.
#pragma once

#include <string>
#include <vector>

#include "lab/trust/whole_robot_trial.hpp"

namespace berth::lab {

/// A row for each condition and number of cameras: how much too large and too small the distances
/// are by more than kTrialTolerance_m, and how often they are 0 though the link is truly free.
std::string whole_robot_table(const std::vector<WholeRobotTrial>& trials,
                              const std::vector<WholeRobotCondition>& conditions);

/// The same under one condition, by how the cameras see the obstacle's point that is truly nearest
/// (WholeRobotTruth::sight). What is outside of all images no camera can tell.
std::string whole_robot_sight_table(const std::vector<WholeRobotTrial>& trials,
                                    std::size_t condition);

/// Under one condition, for each number of cameras and each sight the `count` links whose `nearest`
/// is most too large.
std::string worst_whole_robot_table(const std::vector<WholeRobotTrial>& trials,
                                    std::size_t condition, int count);

/// What a monitor gets from three cameras, a row for each condition: how often a link is 0 though
/// it is truly free, in how many scenes some link is, and how much too far links are whose nearest
/// obstacle point is in an image.
std::string monitor_table(const std::vector<WholeRobotTrial>& trials,
                          const std::vector<WholeRobotCondition>& conditions);

/// Nearer to the truth is right; `mesh` is asked for a tenth of it.
inline constexpr double kTrialTolerance_m = 0.001;

}  // namespace berth::lab
