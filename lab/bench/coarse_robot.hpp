// The same robot in more and in fewer triangles.
#pragma once

#include "berth/robot/robot_model.hpp"

namespace berth::lab {

/// The same surface with parts * parts triangles in place of each one: every edge in `parts` equal
/// parts. Neighbours share positions to the bit, though not vertices.
TriangleMesh subdivide(const TriangleMesh& mesh, int parts);

/// The robot with its collision shapes made coarse (4 500 triangles of the bundled one),
/// then each triangle in parts * parts: the same surface for all parts. Throws as load_robot does.
RobotModel coarse_robot(RobotSettings robot, int parts);

std::size_t triangle_count(const RobotModel& model);

}  // namespace berth::lab
