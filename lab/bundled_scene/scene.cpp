#include "lab/bundled_scene/scene.hpp"

#include "sim/person.hpp"
#include "sim/room.hpp"

namespace berth::lab {
namespace {

std::vector<TriangleMesh> to_meshes(const std::vector<sim::Box>& boxes) {
  std::vector<TriangleMesh> meshes;
  for (const sim::Box& box : boxes) meshes.push_back(sim::to_mesh(box));
  return meshes;
}

void add_still(std::vector<sim::PosedMesh>& to, const std::vector<TriangleMesh>& meshes) {
  for (const TriangleMesh& mesh : meshes) to.push_back({&mesh, Pose::Identity()});
}

}  // namespace

Scene make_scene() {
  return {sim::make_arm_meshes(), to_meshes(sim::table_boxes()), to_meshes(sim::obstacle_boxes()),
          sim::make_person_meshes(), sim::make_joint_rows()};
}

PosedScene pose_scene(const Scene& scene, double time_s) {
  PosedScene posed;
  const std::array<Pose, sim::kArmLinks> X_TL =
      sim::arm_kinematics(sim::interpolate(scene.rows, time_s));
  for (int i = 0; i < sim::kArmLinks; ++i) posed.robot.push_back({&scene.arm[i], X_TL[i]});
  add_still(posed.robot, scene.table);
  add_still(posed.obstacles, scene.boxes);
  const std::vector<Pose> X_TP = sim::person_kinematics(sim::person_motion(time_s));
  for (std::size_t i = 0; i < X_TP.size(); ++i)
    posed.obstacles.push_back({&scene.person[i], X_TP[i]});
  return posed;
}

}  // namespace berth::lab
