#include "lab/watch/hidden_image.hpp"

#include "berth/render/robot_renderer.hpp"
#include "sim/drawn_person.hpp"
#include "sim/random.hpp"

namespace berth::lab {

HiddenImage hidden_image(const OpenCamera& camera, std::uint32_t seed) {
  const Robot& robot = *camera.mounted->robot();
  const RobotModel& model = robot.model();
  sim::Random random(7000 + seed);
  HiddenImage hidden;
  hidden.frame =
      static_cast<std::size_t>(random.whole(0, static_cast<int>(camera.source.depth.size()) - 1));
  RobotPose pose;
  forward_kinematics(model, camera.at_exposure[hidden.frame].position, pose);
  const Pose X_BC = camera.mounted->camera_pose(pose);
  RobotRenderer(robot.meshes(), camera.mounted->camera()).render(pose, X_BC, hidden.robot);
  const auto link = static_cast<std::size_t>(random.whole(1, model.link_count() - 1));
  hidden.depth_m = sim::hide_robot(random(0, 0.9), camera.mounted->camera(), X_BC,
                                   pose.X_BL[model.evaluated_links[link]].translation(),
                                   camera.read_depth(hidden.frame), hidden.robot, seed);
  return hidden;
}

}  // namespace berth::lab
