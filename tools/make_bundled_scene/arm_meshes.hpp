#pragma once

#include <array>

#include "arm.hpp"
#include "mesh.hpp"

namespace berth {

/// The visual mesh of each link, in the link's frame: shells, collars, covers and screws, and a
/// two-finger gripper on the last link.
std::array<TriangleMesh, kArmLinks> make_arm_meshes();

}  // namespace berth
