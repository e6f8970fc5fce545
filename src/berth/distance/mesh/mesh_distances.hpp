#pragma once

#include <vector>

#include "berth/distance/mesh/hidden_space.hpp"
#include "berth/distance/mesh/robot_patches.hpp"
#include "berth/distance/mesh/settings.hpp"
#include "berth/robot/kinematics.hpp"
#include "berth/types/whole_link_distance.hpp"

namespace berth {

/// The memory of mesh_distances(), made once and used for every question; one for each thread that
/// asks.
struct MeshWorkspace;

/// Per link the least distance from all sides of its mesh to what the cameras of `space` saw or
/// could not see (`nearest`), and to what they saw alone (`reading`). out[i] is the link with the
/// id i + 1. If `out` holds an answer on entry, its pairs are the first guess, which changes no
/// distance by more than the tolerance. Allocates nothing once workspace and `out` have grown.
void mesh_distances(const RobotPatches& robot, const RobotPose& pose, const HiddenSpace& space,
                    const MeshQuestion& question, MeshWorkspace& workspace,
                    std::vector<WholeLinkDistance>& out);

}  // namespace berth
