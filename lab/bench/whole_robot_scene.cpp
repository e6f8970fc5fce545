#include "lab/bench/whole_robot_scene.hpp"

#include <cmath>

#include "berth/render/robot_renderer.hpp"
#include "berth/self_filter/self_filter.hpp"

namespace berth::lab {
namespace {

constexpr int kNextRequests = 3;
constexpr double kNextStep_rad = 0.05;
/// Between neighbouring cameras, about a third of a turn.
constexpr double kCameraTurn_rad = 2.1;
constexpr double kCameraTurnSpread_rad = 0.5;

/// Around the upright through the robot's middle.
Pose turned_about(const Eigen::Vector3d& middle_B_m, double angle_rad, const Pose& X_BC) {
  const Eigen::Translation3d to(middle_B_m);
  return to * Eigen::AngleAxisd(angle_rad, Eigen::Vector3d::UnitZ()) * to.inverse() * X_BC;
}

Eigen::Vector3d middle_of(const RobotModel& model, const RobotPose& pose) {
  Eigen::Vector3d sum_B_m = Eigen::Vector3d::Zero();
  for (const std::size_t link : model.evaluated_links) sum_B_m += pose.X_BL[link].translation();
  return sum_B_m / model.link_count();
}

/// The robot where it is in front of the obstacles.
void draw_over(const DepthImage& robot_m, DepthImage& depth_m) {
  for (std::size_t i = 0; i < depth_m.pixels().size(); ++i) {
    const float at_m = robot_m.pixels()[i];
    if (!std::isnan(at_m) && !(depth_m.pixels()[i] < at_m)) depth_m.pixels()[i] = at_m;
  }
}

}  // namespace

WholeRobotScenes::WholeRobotScenes(RobotModel model, int width_px, int height_px)
    : model_(std::move(model)),
      link_trees_(sim::build_link_trees(model_)),
      settings_{.width_px = width_px, .height_px = height_px} {}

WholeRobotScene WholeRobotScenes::draw(std::uint32_t seed) const {
  const sim::DrawnScene drawn = sim::draw_scene(model_, link_trees_, settings_, seed);
  WholeRobotScene scene{drawn.camera, drawn.pose, drawn.joints, {}, {}, {}};
  sim::Random random(seed + 1000);
  const Eigen::Vector3d middle_B_m = middle_of(model_, drawn.pose);
  scene.views.push_back(see(drawn, drawn.X_BC));
  for (int k = 1; k < kSceneCameras; ++k) {
    const double turn_rad =
        kCameraTurn_rad * k + random(-kCameraTurnSpread_rad, kCameraTurnSpread_rad);
    scene.views.push_back(see(drawn, turned_about(middle_B_m, turn_rad, drawn.X_BC)));
  }
  for (int i = 0; i < kNextRequests; ++i) {
    JointState& joints = scene.next_joints.emplace_back(drawn.joints);
    for (double& position : joints.position) position += random(-kNextStep_rad, kNextStep_rad);
    forward_kinematics(model_, joints.position, scene.next_poses.emplace_back());
  }
  return scene;
}

CameraImages WholeRobotScenes::see(const sim::DrawnScene& drawn, const Pose& X_BC) const {
  const RobotModel things = sim::obstacle_model(drawn.obstacles);
  CameraImages images{X_BC, {}, {}, {}};
  RobotImage seen;
  RobotRenderer(build_link_meshes(model_), drawn.camera).render(drawn.pose, X_BC, images.robot);
  RobotRenderer(build_link_meshes(things), drawn.camera)
      .render(sim::obstacle_pose(drawn.obstacles), X_BC, seen);
  images.depth_m = std::move(seen.depth_m);
  draw_over(images.robot.depth_m, images.depth_m);
  SelfFilterWorkspace workspace;
  self_filter(drawn.camera, images.depth_m, images.robot, {}, workspace, images.obstacles);
  return images;
}

}  // namespace berth::lab
