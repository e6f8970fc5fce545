#include "sim/seen_surface.hpp"

#include <algorithm>

namespace berth::sim {
namespace {

using Polygon = std::vector<Eigen::Vector3d>;

/// What of the polygon lies on the side of a plane through the origin that `normal` points to.
Polygon clip_by_plane(const Polygon& polygon, const Eigen::Vector3d& normal) {
  Polygon inside;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Eigen::Vector3d& p = polygon[i];
    const Eigen::Vector3d& q = polygon[(i + 1) % polygon.size()];
    const double p_side = normal.dot(p);
    const double q_side = normal.dot(q);
    if (p_side >= 0) inside.push_back(p);
    if ((p_side >= 0) != (q_side >= 0))
      inside.push_back(p + (q - p) * (p_side / (p_side - q_side)));
  }
  return inside;
}

Polygon clip_to_pixel(Polygon polygon_C, const Camera& camera, int u, int v) {
  const double left = (u - 0.5 - camera.cx_px) / camera.fx_px;
  const double right = (u + 0.5 - camera.cx_px) / camera.fx_px;
  const double top = (v - 0.5 - camera.cy_px) / camera.fy_px;
  const double bottom = (v + 0.5 - camera.cy_px) / camera.fy_px;
  polygon_C = clip_by_plane(polygon_C, {1, 0, -left});
  polygon_C = clip_by_plane(polygon_C, {-1, 0, right});
  polygon_C = clip_by_plane(polygon_C, {0, 1, -top});
  return clip_by_plane(polygon_C, {0, -1, bottom});
}

void append_fan(const Polygon& polygon, TriangleMesh& mesh) {
  if (polygon.size() < 3) return;
  const auto first = static_cast<std::uint32_t>(mesh.vertices_m.size());
  for (const Eigen::Vector3d& p : polygon) mesh.vertices_m.push_back(p.cast<float>());
  for (std::uint32_t i = 2; i < polygon.size(); ++i) {
    mesh.triangles.push_back({first, first + i - 1, first + i});
  }
}

/// The triangles of link `id` that the pixel shows.
std::vector<std::uint32_t> triangles_at(const EmbreeRenderer& rays, int u, int v, LinkId id) {
  std::vector<std::uint32_t> triangles;
  for (const double dv : {0.0, 0.5}) {
    for (const double du : {0.0, 0.5}) {
      const RayHit hit = rays.hit(u + du, v + dv);
      if (hit.id == id) triangles.push_back(hit.triangle);
    }
  }
  std::sort(triangles.begin(), triangles.end());
  triangles.erase(std::unique(triangles.begin(), triangles.end()), triangles.end());
  return triangles;
}

}  // namespace

std::vector<TriangleMesh> seen_surfaces_C(const RobotModel& model, const RobotPose& pose,
                                          const Pose& X_BC, const Camera& camera,
                                          const EmbreeRenderer& rays, const RobotImage& robot) {
  std::vector<Pose> X_CL;
  for (const Pose& X_BL : pose.X_BL) X_CL.push_back(X_BC.inverse() * X_BL);
  std::vector<TriangleMesh> seen_C(model.evaluated_links.size());
  for (int v = 0; v < camera.height_px; ++v) {
    for (int u = 0; u < camera.width_px; ++u) {
      const LinkId id = robot.link_id(u, v);
      if (id == kNoLink || id == kEnvironmentLink) continue;
      const std::size_t link = model.evaluated_links[id - 1];
      const TriangleMesh& mesh_L = model.links[link].mesh_L;
      for (const std::uint32_t triangle : triangles_at(rays, u, v, id)) {
        Polygon corners_C;
        for (const std::uint32_t corner : mesh_L.triangles[triangle]) {
          corners_C.push_back(X_CL[link] * mesh_L.vertices_m[corner].cast<double>());
        }
        append_fan(clip_to_pixel(corners_C, camera, u, v), seen_C[id - 1]);
      }
    }
  }
  return seen_C;
}

}  // namespace berth::sim
