// The whole scene: meshes and motion.
#pragma once

#include <vector>

#include "sim/arm_meshes.hpp"
#include "sim/motion.hpp"
#include "sim/ray_caster.hpp"

namespace berth::lab {

struct Scene {
  std::array<TriangleMesh, sim::kArmLinks> arm;
  std::vector<TriangleMesh> table;
  std::vector<TriangleMesh> boxes;
  std::vector<TriangleMesh> person;
  std::vector<sim::JointRow> rows;
};
Scene make_scene();

/// Points into the scene; all poses in the table's frame.
struct PosedScene {
  std::vector<sim::PosedMesh> robot;  ///< the arm's links first, then the table
  std::vector<sim::PosedMesh> obstacles;
};
PosedScene pose_scene(const Scene& scene, double time_s);

}  // namespace berth::lab
