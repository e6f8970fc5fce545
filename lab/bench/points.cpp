#include "lab/bench/points.hpp"

namespace berth::lab {
namespace {

class BackProjection {
 public:
  explicit BackProjection(const Camera& camera)
      : inv_fx_(static_cast<float>(1 / camera.fx_px)),
        inv_fy_(static_cast<float>(1 / camera.fy_px)),
        cx_(static_cast<float>(camera.cx_px)),
        cy_(static_cast<float>(camera.cy_px)) {}

  Point operator()(int u, int v, float depth_m) const {
    return {(static_cast<float>(u) - cx_) * inv_fx_ * depth_m,
            (static_cast<float>(v) - cy_) * inv_fy_ * depth_m, depth_m};
  }

 private:
  float inv_fx_;
  float inv_fy_;
  float cx_;
  float cy_;
};

bool is_link(LinkId id) { return id != kNoLink && id != kEnvironmentLink; }

Eigen::AlignedBox3f robot_box(const BenchScene& scene, const BackProjection& back_project) {
  Eigen::AlignedBox3f box;
  for (int v = 0; v < scene.camera.height_px; ++v) {
    const LinkId* id = scene.robot.link_id.row(v);
    const float* depth_m = scene.robot.depth_m.row(v);
    for (int u = 0; u < scene.camera.width_px; ++u) {
      if (!is_link(id[u])) continue;
      const Point p = back_project(u, v, depth_m[u]);
      box.extend(Eigen::Vector3f(p[0], p[1], p[2]));
    }
  }
  return box;
}

}  // namespace

void collect_obstacle_points(const BenchScene& scene, std::vector<Point>& points_C_m) {
  points_C_m.clear();
  const BackProjection back_project(scene.camera);
  const Eigen::AlignedBox3f robot = robot_box(scene, back_project);
  if (robot.isEmpty()) return;
  const Eigen::Vector3f range_m = Eigen::Vector3f::Constant(static_cast<float>(scene.range_m));
  const Eigen::AlignedBox3f box(robot.min() - range_m, robot.max() + range_m);
  for (int v = 0; v < scene.camera.height_px; ++v) {
    const float* depth_m = scene.obstacle_depth_m.row(v);
    for (int u = 0; u < scene.camera.width_px; ++u) {
      const Point p = back_project(u, v, depth_m[u]);
      // False for NaN.
      if (box.contains(Eigen::Vector3f(p[0], p[1], p[2]))) points_C_m.push_back(p);
    }
  }
}

void collect_robot_points(const BenchScene& scene, std::vector<std::vector<Point>>& points_C_m) {
  points_C_m.resize(scene.link_count);
  for (auto& points : points_C_m) points.clear();
  const BackProjection back_project(scene.camera);
  for (int v = 0; v < scene.camera.height_px; ++v) {
    const LinkId* id = scene.robot.link_id.row(v);
    const float* depth_m = scene.robot.depth_m.row(v);
    for (int u = 0; u < scene.camera.width_px; ++u) {
      if (is_link(id[u])) points_C_m[id[u] - 1].push_back(back_project(u, v, depth_m[u]));
    }
  }
}

}  // namespace berth::lab
