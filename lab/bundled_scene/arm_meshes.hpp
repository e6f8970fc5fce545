#pragma once

#include <array>

#include "lab/bundled_scene/arm.hpp"
#include "lab/bundled_scene/mesh.hpp"

namespace berth::lab {

/// The visual mesh of each link, in the link's frame: shells, collars, covers and screws, and a
/// two-finger gripper on the last link.
std::array<DrawnMesh, kArmLinks> make_arm_meshes();

}  // namespace berth::lab
