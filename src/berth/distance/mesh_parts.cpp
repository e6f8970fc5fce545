#include "berth/distance/mesh_parts.hpp"

#include <algorithm>
#include <cstdint>
#include <map>
#include <numeric>
#include <utility>

namespace berth::mesh {
namespace {

using Corners = std::array<std::uint32_t, 3>;

/// Of each vertex the first one at its place: files repeat a vertex for each of its triangles.
std::vector<std::uint32_t> first_at_place(const std::vector<Eigen::Vector3f>& vertices_m) {
  std::vector<std::uint32_t> order(vertices_m.size()), first(vertices_m.size());
  std::iota(order.begin(), order.end(), 0u);
  std::ranges::stable_sort(order, [&](std::uint32_t a, std::uint32_t b) {
    return std::ranges::lexicographical_compare(vertices_m[a], vertices_m[b]);
  });
  for (std::size_t i = 0; i < order.size(); ++i) {
    const bool is_same = i > 0 && vertices_m[order[i]] == vertices_m[order[i - 1]];
    first[order[i]] = is_same ? first[order[i - 1]] : order[i];
  }
  return first;
}

std::uint32_t root_of(std::vector<std::uint32_t>& parent, std::uint32_t vertex) {
  while (parent[vertex] != vertex) vertex = parent[vertex] = parent[parent[vertex]];
  return vertex;
}

/// The triangles of each part, by their corners.
std::map<std::uint32_t, std::vector<Corners>> parts_of(const TriangleMesh& mesh) {
  const std::vector<std::uint32_t> first = first_at_place(mesh.vertices_m);
  std::vector<std::uint32_t> parent(first.size());
  std::iota(parent.begin(), parent.end(), 0u);
  std::vector<Corners> triangles;
  for (const auto& [a, b, c] : mesh.triangles) {
    const Corners corners{first[a], first[b], first[c]};
    parent[root_of(parent, corners[1])] = root_of(parent, corners[0]);
    parent[root_of(parent, corners[2])] = root_of(parent, corners[0]);
    triangles.push_back(corners);
  }
  std::map<std::uint32_t, std::vector<Corners>> parts;
  for (const Corners& corners : triangles) parts[root_of(parent, corners[0])].push_back(corners);
  return parts;
}

bool is_closed(const std::vector<Corners>& triangles) {
  std::vector<std::pair<std::uint32_t, std::uint32_t>> edges;
  for (const Corners& corners : triangles) {
    for (std::size_t i = 0; i < 3; ++i) {
      const auto [a, b] = std::minmax({corners[i], corners[(i + 1) % 3]});
      if (a != b) edges.emplace_back(a, b);
    }
  }
  std::ranges::sort(edges);
  for (auto edge = edges.begin(); edge != edges.end();) {
    const auto next = std::find_if(edge, edges.end(), [&](const auto& e) { return e != *edge; });
    if ((next - edge) % 2 != 0) return false;
    edge = next;
  }
  return !edges.empty();
}

/// Whether the ray from p goes through the triangle (Moeller and Trumbore 1997).
bool is_crossed(const Eigen::Vector3d& p_m, const Eigen::Vector3d& ray,
                const std::array<Eigen::Vector3f, 3>& triangle_m) {
  const Eigen::Vector3d a_m = triangle_m[0].cast<double>();
  const Eigen::Vector3d ab_m = triangle_m[1].cast<double>() - a_m;
  const Eigen::Vector3d ac_m = triangle_m[2].cast<double>() - a_m;
  const Eigen::Vector3d across = ray.cross(ac_m);
  const double area = ab_m.dot(across);
  if (area == 0) return false;
  const Eigen::Vector3d ap_m = p_m - a_m;
  const double u = ap_m.dot(across) / area;
  if (u < 0 || u > 1) return false;
  const Eigen::Vector3d along = ap_m.cross(ab_m);
  const double v = ray.dot(along) / area;
  return v >= 0 && u + v <= 1 && ac_m.dot(along) / area > 0;
}

}  // namespace

MeshParts::MeshParts(const TriangleMesh& mesh) {
  for (const auto& [root, triangles] : parts_of(mesh)) {
    corners_m_.push_back(mesh.vertices_m[root]);
    if (!is_closed(triangles)) continue;
    Closed& part = closed_.emplace_back();
    for (const Corners& corners : triangles) {
      Triangle& triangle_m = part.triangles_m.emplace_back();
      for (std::size_t i = 0; i < 3; ++i) {
        triangle_m[i] = mesh.vertices_m[corners[i]];
        part.box_m.extend(triangle_m[i]);
      }
    }
  }
}

bool MeshParts::enclose(const Eigen::Vector3d& p_m) const {
  // Along no edge of a mesh that somebody would make.
  const Eigen::Vector3d ray(0.5371, 0.4763, 0.6961);
  return std::ranges::any_of(closed_, [&](const Closed& part) {
    if (!part.box_m.contains(p_m.cast<float>())) return false;
    const auto crossings = std::ranges::count_if(part.triangles_m, [&](const Triangle& triangle_m) {
      return is_crossed(p_m, ray, triangle_m);
    });
    return crossings % 2 != 0;
  });
}

}  // namespace berth::mesh
