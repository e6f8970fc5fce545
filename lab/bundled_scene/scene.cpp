#include "lab/bundled_scene/scene.hpp"

#include "lab/bundled_scene/person.hpp"
#include "lab/bundled_scene/room.hpp"

namespace berth::lab {
namespace {

std::vector<DrawnMesh> to_meshes(const std::vector<Box>& boxes) {
  std::vector<DrawnMesh> meshes;
  for (const Box& box : boxes) meshes.push_back(to_mesh(box));
  return meshes;
}

void add_still(std::vector<PosedMesh>& to, const std::vector<DrawnMesh>& meshes) {
  for (const DrawnMesh& mesh : meshes) to.push_back({&mesh, Pose::Identity()});
}

}  // namespace

Scene make_scene() {
  return {make_arm_meshes(), to_meshes(table_boxes()), to_meshes(obstacle_boxes()),
          make_person_meshes(), make_joint_rows()};
}

PosedScene pose_scene(const Scene& scene, double time_s) {
  PosedScene posed;
  const std::array<Pose, kArmLinks> X_TL = arm_kinematics(interpolate(scene.rows, time_s));
  for (int i = 0; i < kArmLinks; ++i) posed.robot.push_back({&scene.arm[i], X_TL[i]});
  add_still(posed.robot, scene.table);
  add_still(posed.obstacles, scene.boxes);
  const std::vector<Pose> X_TP = person_kinematics(person_motion(time_s));
  for (std::size_t i = 0; i < X_TP.size(); ++i)
    posed.obstacles.push_back({&scene.person[i], X_TP[i]});
  return posed;
}

}  // namespace berth::lab
