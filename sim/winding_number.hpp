#pragma once

#include <Eigen/Core>

#include "berth/robot/triangle_mesh.hpp"

namespace berth::sim {

/// How often a closed mesh goes around a point: 1 inside where it is wound counterclockwise as seen
/// from outside, 0 outside. By its triangles' solid angles (van Oosterom and Strackee).
double winding_number(const TriangleMesh& mesh, const Eigen::Vector3d& p_m);

}  // namespace berth::sim
