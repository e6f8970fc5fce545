#include "sim/drawn_camera.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace berth::sim {

RobotExtent extent_of(const RobotModel& model, const RobotPose& pose) {
  Eigen::AlignedBox3d evaluated_B;
  double lowest_z_m = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < model.links.size(); ++i) {
    for (const auto& vertex : model.links[i].mesh_L.vertices_m) {
      const Eigen::Vector3d p_B = pose.X_BL[i] * vertex.cast<double>();
      if (model.links[i].role == LinkRole::evaluated) evaluated_B.extend(p_B);
      lowest_z_m = std::min(lowest_z_m, p_B.z());
    }
  }
  return {evaluated_B.center(), evaluated_B.diagonal().norm() / 2, lowest_z_m};
}

Camera draw_camera(Random& random, int width_px, int height_px) {
  Camera camera{width_px, height_px};
  camera.fx_px = width_px * random(0.6, 1.1);
  camera.fy_px = camera.fx_px * random(0.98, 1.02);
  camera.cx_px = width_px * random(0.47, 0.53) - 0.5;
  camera.cy_px = height_px * random(0.47, 0.53) - 0.5;
  return camera;
}

Pose draw_camera_pose(Random& random, const RobotExtent& robot) {
  const double around = random(-std::numbers::pi, std::numbers::pi);
  const double up = random(-0.2, 1.2);
  const Eigen::Vector3d away(std::cos(up) * std::cos(around), std::cos(up) * std::sin(around),
                             std::sin(up));
  const Eigen::Vector3d target_B_m =
      robot.centre_B_m +
      0.4 * robot.radius_m * Eigen::Vector3d(random(-1, 1), random(-1, 1), random(-1, 1));
  const double distance_m = robot.radius_m * random(1.3, 3.5);
  const Eigen::Vector3d z = -away;
  const Eigen::Vector3d x = z.cross(Eigen::Vector3d::UnitZ()).normalized();
  Pose X_BC;
  X_BC.linear() << x, z.cross(x), z;
  X_BC.linear() *=
      Eigen::AngleAxisd(random(-0.3, 0.3), Eigen::Vector3d::UnitZ()).toRotationMatrix();
  X_BC.translation() = target_B_m + distance_m * away;
  return X_BC;
}

RobotImage cast_image(const EmbreeRenderer& rays, const Camera& camera) {
  RobotImage image;
  image.depth_m = DepthImage(camera.width_px, camera.height_px, kNoDepth);
  image.link_id = Image<LinkId>(camera.width_px, camera.height_px, kNoLink);
  for (int v = 0; v < camera.height_px; ++v) {
    for (int u = 0; u < camera.width_px; ++u) {
      const RayHit hit = rays.hit(u, v);
      if (hit.id == kNoLink) continue;
      image.depth_m(u, v) = static_cast<float>(hit.depth_m);
      image.link_id(u, v) = hit.id;
    }
  }
  return image;
}

double robot_share(const RobotImage& image) {
  const auto& ids = image.link_id.pixels();
  const auto seen = std::count_if(
      ids.begin(), ids.end(), [](LinkId id) { return id != kNoLink && id != kEnvironmentLink; });
  return static_cast<double>(seen) / static_cast<double>(ids.size());
}

}  // namespace berth::sim
