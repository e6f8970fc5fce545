// Inside robot/ only.
#pragma once

#include "berth/robot/robot_model.hpp"
#include "berth/robot/urdf.hpp"

namespace berth {

/// Links and joints without shapes and roles. Floating and planar joints are fixed ones. Throws as
/// Urdf does where they are no tree, or a mimic chain ends at no joint that moves.
RobotModel read_tree(const Urdf& urdf);

}  // namespace berth
