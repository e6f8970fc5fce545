#pragma once

#include <filesystem>
#include <vector>

#include "lab/trust/trial.hpp"

namespace berth::lab {

/// The bundled arm (its table is environment).
TrialRobot load_bundled_robot();

/// The bundled arm, then every URDF in a folder of `robots_folder` (robots/NAME/NAME.urdf), sorted;
/// the bundled one alone where the folder's path is empty. Throws std::runtime_error as load_robot.
std::vector<TrialRobot> load_trial_robots(const std::filesystem::path& robots_folder);

}  // namespace berth::lab
