#include "tests/image_distance/visibility/random_view.hpp"
#include "berth/render/robot_renderer.hpp"

#include <algorithm>
#include <random>

#include "tests/render/small_robot.hpp"

namespace berth {
namespace {

/// Looks at the middle of the robot.
Pose random_camera_pose(const RobotModel& model, const RobotPose& pose, std::mt19937& random) {
  Eigen::AlignedBox3d box_B_m;
  for (const std::size_t i : model.evaluated_links) {
    for (const auto& vertex : model.links[i].mesh_L.vertices_m)
      box_B_m.extend(pose.X_BL[i] * vertex.cast<double>());
  }
  Pose X_BC = random_pose(random, {Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero()});
  const double sizes = std::uniform_real_distribution<double>(0.5, 1.3)(random);
  X_BC.translation() = box_B_m.center() - sizes * box_B_m.diagonal().norm() * X_BC.linear().col(2);
  return X_BC;
}

void draw_rectangles(float depth_m, int count, std::mt19937& random, DepthImage& image) {
  for (int i = 0; i < count; ++i) {
    const int u = static_cast<int>(random() % image.width());
    const int v = static_cast<int>(random() % image.height());
    const PixelRect rect =
        clip({u, v, u + image.width() / 6, v + image.height() / 6}, image.width(), image.height());
    for (int y = rect.v_begin; y < rect.v_end; ++y)
      std::fill(image.row(y) + rect.u_begin, image.row(y) + rect.u_end, depth_m);
  }
}

}  // namespace

RandomView::RandomView(const RobotModel& model, const Camera& any_camera, std::uint32_t seed)
    : camera(any_camera) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> angle_rad(-1.5, 1.5);
  std::vector<double> positions(model.joints.size());
  for (double& position : positions) position = angle_rad(random);
  forward_kinematics(model, positions, pose);
  X_BC = random_camera_pose(model, pose, random);
  for (double& position : positions) position += 0.1 * angle_rad(random);
  forward_kinematics(model, positions, asked_pose);

  RobotRenderer renderer(build_link_meshes(model), camera);
  renderer.render(pose, X_BC, robot);
  renderer.render(asked_pose, X_BC, asked_robot);
  sensor_depth_m = robot.depth_m;
  for (float& depth_m : sensor_depth_m.pixels()) depth_m = std::isnan(depth_m) ? 4 : depth_m;
  draw_rectangles(0.3F, 4, random, sensor_depth_m);
  draw_rectangles(kNoDepth, 4, random, sensor_depth_m);
  SelfFilterWorkspace workspace;
  self_filter(camera, sensor_depth_m, robot, settings, workspace, obstacles);
  plain_robot_ = std::make_unique<sim::EmbreeRenderer>(model, pose, X_BC, camera);
  plain_asked_robot_ = std::make_unique<sim::EmbreeRenderer>(model, asked_pose, X_BC, camera);
}

PlainView RandomView::plain() const {
  return {camera,        sensor_depth_m,     obstacles.fate, settings.tolerance_m,
          *plain_robot_, *plain_asked_robot_};
}

}  // namespace berth
