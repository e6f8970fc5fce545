#include "tests/render/slow_renderer.hpp"

namespace berth {
namespace {

/// Möller and Trumbore, from both sides; infinity where the ray t * direction misses.
double ray_triangle(const Eigen::Vector3d& direction, const std::array<Eigen::Vector3d, 3>& p) {
  constexpr double kMiss = std::numeric_limits<double>::infinity();
  const Eigen::Vector3d ab = p[1] - p[0];
  const Eigen::Vector3d ac = p[2] - p[0];
  const Eigen::Vector3d n = direction.cross(ac);
  const double determinant = ab.dot(n);
  if (determinant == 0) return kMiss;
  const double s = -p[0].dot(n) / determinant;
  const Eigen::Vector3d m = (-p[0]).cross(ab);
  const double r = direction.dot(m) / determinant;
  if (s < 0 || r < 0 || s + r > 1) return kMiss;
  const double t = ac.dot(m) / determinant;
  return t > 0 ? t : kMiss;
}

}  // namespace

SlowRenderer::SlowRenderer(const RobotModel& model, const RobotPose& pose, const Pose& X_BC,
                           const Camera& camera)
    : camera_(camera) {
  for (std::size_t i = 0; i < model.links.size(); ++i) {
    const Link& link = model.links[i];
    if (link.role == LinkRole::ignored) continue;
    const Pose X_CL = X_BC.inverse() * pose.X_BL[i];
    for (const auto& triangle : link.mesh_L.triangles) {
      Triangle t;
      t.id = link.id;
      for (std::size_t corner = 0; corner < 3; ++corner)
        t.corners_C_m[corner] = X_CL * link.mesh_L.vertices_m[triangle[corner]].cast<double>();
      triangles_.push_back(t);
    }
  }
}

sim::RayHit SlowRenderer::hit_beyond(double u, double v, double least_m) const {
  const Eigen::Vector3d direction((u - camera_.cx_px) / camera_.fx_px,
                                  (v - camera_.cy_px) / camera_.fy_px, 1);
  sim::RayHit nearest;
  for (const Triangle& triangle : triangles_) {
    const double depth_m = ray_triangle(direction, triangle.corners_C_m);
    if (depth_m > least_m && depth_m < nearest.depth_m) nearest = {triangle.id, depth_m};
  }
  return nearest;
}

}  // namespace berth
