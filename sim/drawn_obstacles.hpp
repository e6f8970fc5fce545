#pragma once

#include "berth/robot/triangle_mesh.hpp"
#include "sim/random.hpp"

namespace berth::sim {

/// A box, a sphere, a cylinder, or a mesh with hollows (a lump, a stool), around its own origin.
/// It reaches `radius_m` from there, a sphere or cylinder up to 1 % farther.
TriangleMesh draw_obstacle(Random& random, double radius_m);

/// Uniform among all rotations.
Eigen::Quaterniond draw_rotation(Random& random);

}  // namespace berth::sim
