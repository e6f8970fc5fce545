#include "lab/implausible/good_scenes.hpp"

#include "berth/render/robot_renderer.hpp"
#include "lab/implausible/mistakes.hpp"
#include "tests/support/drawn_person.hpp"
#include "tests/support/random.hpp"

namespace berth::lab {
namespace {

Eigen::Vector3d direction(testing::Random& random) {
  for (;;) {
    const Eigen::Vector3d v(random(-1, 1), random(-1, 1), random(-1, 1));
    if (v.norm() > 0.1 && v.norm() < 1) return v.normalized();
  }
}

}  // namespace

void move_camera(OpenScene& scene, std::size_t c, double offset_m, double angle_rad,
                 std::uint32_t seed) {
  testing::Random random(300 + seed);
  CameraMount mount = scene.cameras[c].view->mount();
  const Eigen::Vector3d offset = offset_m * direction(random);
  mount.X_PC = mount.X_PC * Eigen::Translation3d(offset) *
               Eigen::AngleAxisd(angle_rad, direction(random));
  set_mount(scene, scene.cameras[c], mount);
}

void hide_robot(OpenScene& scene, std::size_t c, std::uint32_t seed) {
  OpenCamera& camera = scene.cameras[c];
  const RobotModel& model = scene.robot->model();
  testing::Random random(7000 + seed);
  const auto k = static_cast<std::size_t>(
      random.whole(0, static_cast<int>(camera.source.depth.size()) - 1));
  RobotPose pose;
  forward_kinematics(model, camera.at_exposure[k].position, pose);
  RobotRenderer renderer(scene.robot->meshes(), camera.view->camera());
  RobotImage robot;
  const Pose X_BC = camera.view->camera_pose(pose);
  renderer.render(pose, X_BC, robot);
  const auto link = static_cast<std::size_t>(random.whole(1, model.link_count() - 1));
  const DepthImage hidden_m = testing::hide_robot(
      random(0, 0.9), camera.view->camera(), X_BC,
      pose.X_BL[model.evaluated_links[link]].translation(), camera.read_depth(k), robot, seed);
  camera.at_exposure = {camera.at_exposure[k]};
  camera.exposure_time = {camera.exposure_time[k]};
  camera.kept_depth_m = {std::make_shared<const DepthImage>(hidden_m)};
  camera.source.depth = {camera.source.depth[k]};
}

}  // namespace berth::lab
