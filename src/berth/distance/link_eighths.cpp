#include "berth/distance/link_eighths.hpp"

#include "berth/space/serial_number.hpp"

namespace berth {
namespace {

using Polygon = std::vector<Eigen::Vector3f>;
using Polygons = std::vector<Polygon>;

/// The part of a convex polygon on one side of the plane x[axis] = at_m; the side +1 is above it.
Polygon cut(const Polygon& polygon, int axis, float at_m, float side) {
  Polygon part;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Eigen::Vector3f &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
    const float above_a_m = side * (a[axis] - at_m), above_b_m = side * (b[axis] - at_m);
    if (above_a_m >= 0) part.push_back(a);
    // An edge with an end on the plane has no other point in it.
    if (above_a_m * above_b_m < 0) {
      part.push_back(a + above_a_m / (above_a_m - above_b_m) * (b - a));
    }
  }
  return part;
}

/// On both sides of a plane, which lies below first and above last.
std::array<Polygons, 2> cut(const Polygons& polygons, int axis, float at_m) {
  std::array<Polygons, 2> halves;
  for (const Polygon& polygon : polygons) {
    for (const std::size_t half : {0, 1}) {
      Polygon part = cut(polygon, axis, at_m, half == 0 ? -1.0F : 1.0F);
      if (part.size() >= 3) halves[half].push_back(std::move(part));
    }
  }
  return halves;
}

TriangleMesh mesh_of(const Polygons& polygons) {
  TriangleMesh mesh;
  for (const Polygon& polygon : polygons) {
    const auto first = static_cast<std::uint32_t>(mesh.vertices_m.size());
    mesh.vertices_m.insert(mesh.vertices_m.end(), polygon.begin(), polygon.end());
    for (std::uint32_t k = 2; k < polygon.size(); ++k) {
      mesh.triangles.push_back({first, first + k - 1, first + k});
    }
  }
  return mesh;
}

void add_eighths(const TriangleMesh& mesh_L, std::size_t link, RobotPatches& out) {
  std::vector<Polygons> parts(1);
  for (const auto& [a, b, c] : mesh_L.triangles) {
    parts[0].push_back({mesh_L.vertices_m[a], mesh_L.vertices_m[b], mesh_L.vertices_m[c]});
  }
  const Eigen::Vector3f middle_m = mesh_L.bounding_box_m().center();
  for (int axis = 0; axis < 3; ++axis) {
    std::vector<Polygons> halves;
    for (const Polygons& part : parts) {
      for (Polygons& half : cut(part, axis, middle_m[axis])) halves.push_back(std::move(half));
    }
    parts = std::move(halves);
  }
  for (const Polygons& part : parts) {
    if (part.empty()) continue;
    out.links.push_back(build_link_patches(mesh_of(part)));
    out.links.back().link = link;
  }
}

}  // namespace

std::shared_ptr<const RobotPatches> build_link_eighths(const RobotModel& model) {
  auto eighths = std::make_shared<RobotPatches>();
  eighths->serial_number = mesh::next_serial_number();
  for (const std::size_t link : model.evaluated_links) {
    const TriangleMesh& mesh_L = model.links[link].mesh_L;
    if (model.is_moved(link) && !mesh_L.empty()) add_eighths(mesh_L, link, *eighths);
  }
  return eighths;
}

}  // namespace berth
