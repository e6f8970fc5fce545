// Cameras that the robot carries, and that see other parts of it.
#pragma once

#include <cstdint>
#include <vector>

#include "berth/fit/calibration_data.hpp"
#include "berth/robot/kinematics.hpp"
#include "sim/random.hpp"

namespace berth::sim {

/// What a camera is fixed to: the root link, the first link that the last joint of the longest
/// chain turns, or one half the way up that chain.
enum class DrawnMount { root, hand, upper_link };

/// Index of that link. Throws std::runtime_error where no joint turns.
std::size_t mount_link(const RobotModel& model, DrawnMount mount);

/// Sets the camera's parent, its image (of this size) and X_PC: near to its link, looking at links
/// that move before it. They fill at least 2 % of most images, and no link fills half of one or
/// comes nearer than 8 cm. False where no such camera was found.
bool place_hand_camera(Random& random, const RobotModel& model, const std::vector<RobotPose>& poses,
                       DrawnMount mount, int width_px, int height_px, CalibrationCamera& camera);

}  // namespace berth::sim
