#include "lab/bench/coarsen.hpp"

#include <array>
#include <cmath>
#include <map>

namespace berth::lab {

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

}  // namespace berth::lab
