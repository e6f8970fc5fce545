// The whole scene: meshes and motion.
#pragma once

#include <vector>

#include "lab/bundled_scene/arm_meshes.hpp"
#include "lab/bundled_scene/motion.hpp"
#include "lab/bundled_scene/ray_caster.hpp"

namespace berth::lab {

struct Scene {
  std::array<DrawnMesh, kArmLinks> arm;
  std::vector<DrawnMesh> table;
  std::vector<DrawnMesh> boxes;
  std::vector<DrawnMesh> person;
  std::vector<JointRow> rows;
};
Scene make_scene();

/// Points into the scene; all poses in the table's frame.
struct PosedScene {
  std::vector<PosedMesh> robot;  ///< the arm's links first, then the table
  std::vector<PosedMesh> obstacles;
};
PosedScene pose_scene(const Scene& scene, double time_s);

}  // namespace berth::lab
