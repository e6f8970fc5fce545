#include "sim/true_distance.hpp"

#include <algorithm>
#include <cmath>

#include "sim/embree_renderer.hpp"
#include "sim/seen_surface.hpp"

namespace berth::sim {
namespace {

/// A point of a surface lies in front of it by rounding.
constexpr double kDepthRounding_m = 1e-3;

SurfacePair closest_obstacle(const MeshTree& tree, const Pose& X_WM,
                             const std::vector<MeshTree>& obstacles,
                             const std::vector<Pose>& X_WO) {
  SurfacePair closest;
  for (std::size_t i = 0; i < obstacles.size(); ++i) {
    const SurfacePair pair = closest_points(tree, X_WM, obstacles[i], X_WO[i], closest.distance_m);
    if (pair.distance_m < closest.distance_m) closest = pair;
  }
  return closest;
}

}  // namespace

ObstacleSight sight_of(const Eigen::Vector3d& p_C, const Camera& camera,
                       DepthView obstacle_depth_m) {
  const double u = camera.fx_px * p_C.x() / p_C.z() + camera.cx_px;
  const double v = camera.fy_px * p_C.y() / p_C.z() + camera.cy_px;
  const bool is_inside = p_C.z() > 0 && u >= -0.5 && v >= -0.5 && u <= camera.width_px - 0.5 &&
                         v <= camera.height_px - 0.5;
  if (!is_inside) return ObstacleSight::outside;
  // At an outline the pixel's own centre may miss the obstacle.
  const int u0 = static_cast<int>(std::lround(u));
  const int v0 = static_cast<int>(std::lround(v));
  const PixelRect around =
      clip({u0 - 1, v0 - 1, u0 + 2, v0 + 2}, camera.width_px, camera.height_px);
  for (int y = around.v_begin; y < around.v_end; ++y) {
    for (int x = around.u_begin; x < around.u_end; ++x) {
      if (obstacle_depth_m(x, y) <= p_C.z() + kDepthRounding_m) return ObstacleSight::covered;
    }
  }
  return ObstacleSight::behind_robot;
}

std::vector<TrueDistance> true_distances(const RobotModel& model,
                                         const std::vector<MeshTree>& link_trees,
                                         const DrawnScene& scene) {
  std::vector<MeshTree> obstacles;
  std::vector<Pose> X_BO;
  std::vector<Pose> X_CO;
  for (const DrawnObstacle& obstacle : scene.obstacles) {
    obstacles.push_back(build_mesh_tree(obstacle.mesh_O));
    X_BO.push_back(obstacle.X_BO);
    X_CO.push_back(scene.X_BC.inverse() * obstacle.X_BO);
  }
  const EmbreeRenderer rays(model, scene.pose, scene.X_BC, scene.camera);
  const std::vector<TriangleMesh> seen_C =
      seen_surfaces_C(model, scene.pose, scene.X_BC, scene.camera, rays, scene.robot);
  std::vector<TrueDistance> truth(seen_C.size());
  for (std::size_t i = 0; i < truth.size(); ++i) {
    const std::size_t link = model.evaluated_links[i];
    truth[i].whole_m =
        closest_obstacle(link_trees[link], scene.pose.X_BL[link], obstacles, X_BO).distance_m;
    truth[i].seen_C =
        closest_obstacle(build_mesh_tree(seen_C[i]), Pose::Identity(), obstacles, X_CO);
    if (seen_C[i].empty()) continue;
    truth[i].sight = sight_of(truth[i].seen_C.b_m, scene.camera, scene.obstacle_depth_m);
  }
  return truth;
}

double pixel_size_m(const Camera& camera, const TrueDistance& truth) {
  return std::max(truth.seen_C.a_m.z(), truth.seen_C.b_m.z()) /
         std::min(camera.fx_px, camera.fy_px);
}

double max_overestimate_m(const Camera& camera, const TrueDistance& truth) {
  const Eigen::Vector3d& ray = truth.seen_C.b_m;
  const double inv_cos = ray.norm() / ray.z();
  return (inv_cos - 1) * truth.seen_C.distance_m +
         kMaxOverestimate_px * pixel_size_m(camera, truth);
}

}  // namespace berth::sim
