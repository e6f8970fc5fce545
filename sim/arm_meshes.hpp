#pragma once

#include <array>

#include "sim/arm.hpp"
#include "sim/shapes.hpp"

namespace berth::sim {

/// The visual mesh of each link, in the link's frame: shells, collars, covers and screws, and a
/// two-finger gripper on the last link.
std::array<TriangleMesh, kArmLinks> make_arm_meshes();

}  // namespace berth::sim
