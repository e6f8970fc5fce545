// What does not move. The table's frame T is the scene's: origin on the table's top below the arm,
// z up, x towards the person.
#pragma once

#include <string>
#include <vector>

#include "sim/shapes.hpp"

namespace berth::sim {

/// A box with its centre at centre_T_m, along the axes of T.
struct Box {
  std::string name;
  Eigen::Vector3d size_m;
  Eigen::Vector3d centre_T_m;
};

inline constexpr double kFloorZ_m = -0.750;

/// The table's top and legs: part of the URDF.
const std::vector<Box>& table_boxes();

/// Three boxes on the table, a cabinet, the floor and the back wall: obstacles.
const std::vector<Box>& obstacle_boxes();

/// The box as a mesh in T.
TriangleMesh to_mesh(const Box& box);

}  // namespace berth::sim
