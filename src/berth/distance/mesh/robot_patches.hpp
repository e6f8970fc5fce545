#pragma once

#include <memory>

#include "berth/robot/robot_model.hpp"

namespace berth {

/// The surfaces of all evaluated links, each as a tree of patches of triangles in the link's own
/// frame: constant, shared by all askers.
struct RobotPatches;

std::shared_ptr<const RobotPatches> build_robot_patches(const RobotModel& model);

}  // namespace berth
