// A walking, reaching person of rigid parts.
#pragma once

#include <vector>

#include "sim/motion.hpp"
#include "sim/shapes.hpp"

namespace berth::sim {

/// From joint to joint.
inline constexpr double kThigh_m = 0.43, kShin_m = 0.42, kUpperArm_m = 0.30, kForearm_m = 0.27;

/// Trunk, head, arms, hands, legs and feet, each in its own frame.
std::vector<TriangleMesh> make_person_meshes();

/// Along z from the wrist, the palm across x.
TriangleMesh make_hand();

/// X_TP of each part, in the order of make_person_meshes().
std::vector<Pose> person_kinematics(const PersonMotion& motion);

}  // namespace berth::sim
