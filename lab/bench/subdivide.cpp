#include "lab/bench/subdivide.hpp"

namespace berth::lab {
namespace {

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

}  // namespace berth::lab
