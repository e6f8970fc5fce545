#include "lab/bench/coarse_robot.hpp"

#include <array>
#include <cmath>
#include <map>

namespace berth::lab {
namespace {

constexpr float kCell_m = 0.02f;

/// Fewer triangles of about the same shape: the vertices in each cube of side cell_m become one, at
/// their mean, and triangles that lose a corner fall away. No vertex moves by more than the cube's
/// diagonal.
TriangleMesh coarsen(const TriangleMesh& mesh, float cell_m) {
  TriangleMesh coarse;
  std::map<std::array<int, 3>, std::uint32_t> vertex_of_cell;
  std::vector<std::uint32_t> vertex_of;
  std::vector<int> count;
  for (const Eigen::Vector3f& p : mesh.vertices_m) {
    std::array<int, 3> cell;
    for (int axis = 0; axis < 3; ++axis) {
      cell[axis] = static_cast<int>(std::floor(p[axis] / cell_m));
    }
    const auto next = static_cast<std::uint32_t>(count.size());
    const std::uint32_t vertex = vertex_of_cell.try_emplace(cell, next).first->second;
    if (vertex == next) {
      coarse.vertices_m.push_back(Eigen::Vector3f::Zero());
      count.push_back(0);
    }
    coarse.vertices_m[vertex] += p;
    ++count[vertex];
    vertex_of.push_back(vertex);
  }
  for (std::size_t i = 0; i < count.size(); ++i) {
    coarse.vertices_m[i] /= static_cast<float>(count[i]);
  }
  for (const auto& [a, b, c] : mesh.triangles) {
    const std::array corners = {vertex_of[a], vertex_of[b], vertex_of[c]};
    if (corners[0] == corners[1] || corners[1] == corners[2] || corners[2] == corners[0]) continue;
    coarse.triangles.push_back(corners);
  }
  return coarse;
}

/// Rows of points from corner a to the edge b c: row i has i + 1 points.
std::uint32_t point_index(int row, int place) {
  return static_cast<std::uint32_t>(row * (row + 1) / 2 + place);
}

}  // namespace

TriangleMesh subdivide(const TriangleMesh& mesh, int parts) {
  TriangleMesh fine;
  for (const auto& [a, b, c] : mesh.triangles) {
    const auto first = static_cast<std::uint32_t>(fine.vertices_m.size());
    for (int row = 0; row <= parts; ++row) {
      for (int place = 0; place <= row; ++place) {
        // Symmetric in the corners, so that a neighbour rounds alike.
        const Eigen::Vector3d sum_m = (parts - row) * mesh.vertices_m[a].cast<double>() +
                                      (row - place) * mesh.vertices_m[b].cast<double>() +
                                      place * mesh.vertices_m[c].cast<double>();
        fine.vertices_m.push_back((sum_m / parts).cast<float>());
      }
    }
    for (int row = 0; row < parts; ++row) {
      for (int place = 0; place <= row; ++place) {
        const std::uint32_t above = first + point_index(row, place);
        const std::uint32_t below = first + point_index(row + 1, place);
        fine.triangles.push_back({above, below, below + 1});
        if (place < row) fine.triangles.push_back({above, below + 1, above + 1});
      }
    }
  }
  return fine;
}

RobotModel coarse_robot(RobotSettings robot, int parts) {
  robot.geometry = GeometryKind::collision;
  RobotModel model = load_robot(robot);
  for (Link& link : model.links) link.mesh_L = subdivide(coarsen(link.mesh_L, kCell_m), parts);
  return model;
}

std::size_t triangle_count(const RobotModel& model) {
  std::size_t count = 0;
  for (const Link& link : model.links) count += link.mesh_L.triangles.size();
  return count;
}

}  // namespace berth::lab
