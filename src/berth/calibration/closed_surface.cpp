#include "berth/calibration/closed_surface.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace berth {
namespace {

/// The cells between two nodes of the surface: the first distance that needs few triangles.
constexpr std::array kSteps = {2, 3, 4, 5, 6, 8, 10, 12, 16};

/// A field with each step-th node of a finer one, and the surface where it is `level`.
class SurfaceNet {
 public:
  SurfaceNet(const Cell& fine_size, const std::vector<float>& fine, int step, float level)
      : size_((fine_size.array() - 1) / step + 1), values_(static_cast<std::size_t>(size_.prod())) {
    for (int z = 0; z < size_.z(); ++z) {
      for (int y = 0; y < size_.y(); ++y) {
        for (int x = 0; x < size_.x(); ++x) {
          const Cell at = step * Cell(x, y, z);
          const std::size_t from =
              (static_cast<std::size_t>(at.z()) * static_cast<std::size_t>(fine_size.y()) +
               static_cast<std::size_t>(at.y())) *
                  static_cast<std::size_t>(fine_size.x()) +
              static_cast<std::size_t>(at.x());
          values_[index({x, y, z})] = fine[from] - level;
        }
      }
    }
  }

  /// In nodes of this field. Each cube of nodes on both sides of the surface has one vertex, each
  /// edge that goes through the surface one quadrangle.
  TriangleMesh mesh() {
    vertex_of_.assign(values_.size(), -1);
    TriangleMesh mesh;
    each_node([&](const Cell& at) { add_vertex(at, mesh); });
    each_node([&](const Cell& at) {
      for (int axis = 0; axis < 3; ++axis) add_quadrangle(at, axis, mesh);
    });
    return mesh;
  }

 private:
  std::size_t index(const Cell& at) const {
    return (static_cast<std::size_t>(at.z()) * static_cast<std::size_t>(size_.y()) +
            static_cast<std::size_t>(at.y())) *
               static_cast<std::size_t>(size_.x()) +
           static_cast<std::size_t>(at.x());
  }

  template <class Visit>
  void each_node(const Visit& visit) const {
    for (int z = 0; z + 1 < size_.z(); ++z) {
      for (int y = 0; y + 1 < size_.y(); ++y) {
        for (int x = 0; x + 1 < size_.x(); ++x) visit(Cell(x, y, z));
      }
    }
  }

  /// The mean of where the cube's edges meet the surface.
  void add_vertex(const Cell& at, TriangleMesh& mesh) {
    Eigen::Vector3f sum = Eigen::Vector3f::Zero();
    int count = 0;
    for (int axis = 0; axis < 3; ++axis) {
      for (int corner = 0; corner < 4; ++corner) {
        Cell from = at;
        from[(axis + 1) % 3] += corner & 1;
        from[(axis + 2) % 3] += corner >> 1;
        const float a = values_[index(from)];
        const float b = values_[index(from + Cell::Unit(axis))];
        if ((a < 0) == (b < 0)) continue;
        sum += from.cast<float>() + a / (a - b) * Eigen::Vector3f::Unit(axis);
        ++count;
      }
    }
    if (count == 0) return;
    vertex_of_[index(at)] = static_cast<int>(mesh.vertices_m.size());
    mesh.vertices_m.push_back(sum / static_cast<float>(count));
  }

  /// Around the edge from `at` along `axis`.
  void add_quadrangle(const Cell& at, int axis, TriangleMesh& mesh) const {
    const Cell b = Cell::Unit((axis + 1) % 3);
    const Cell c = Cell::Unit((axis + 2) % 3);
    const bool is_inside = values_[index(at)] < 0;
    if (is_inside == (values_[index(at + Cell::Unit(axis))] < 0)) return;
    std::array<std::uint32_t, 4> ring{};
    const std::array<Cell, 4> cubes = {Cell(at), Cell(at - b), Cell(at - b - c), Cell(at - c)};
    for (std::size_t i = 0; i < 4; ++i) {
      ring[i] = static_cast<std::uint32_t>(vertex_of_[index(cubes[i])]);
    }
    if (!is_inside) std::swap(ring[1], ring[3]);
    mesh.triangles.push_back({ring[0], ring[1], ring[2]});
    mesh.triangles.push_back({ring[0], ring[2], ring[3]});
  }

  Cell size_;
  std::vector<float> values_;
  std::vector<int> vertex_of_;
};

}  // namespace

TriangleMesh closed_surface(const SolidCells& solid, double padding_m) {
  const double padding = std::max(padding_m, kLeastSurfacePadding_m) / kCell_m;
  TriangleMesh mesh;
  for (const int step : kSteps) {
    // A cell's own half, and what straight edges between nodes cut off a round surface.
    const auto level = static_cast<float>(padding + 0.5 + step / 8.0);
    const int margin = static_cast<int>(std::ceil(level)) + 2 * step;
    const Cell size = solid.size + Cell::Constant(2 * margin);
    // One more node, where the last is no multiple of the step, lies in the margin.
    mesh = SurfaceNet(size, distance_field(solid, margin), step, level).mesh();
    for (Eigen::Vector3f& vertex : mesh.vertices_m) {
      vertex =
          (static_cast<float>(step) * vertex +
           (solid.first - Cell::Constant(margin)).cast<float>() + Eigen::Vector3f::Constant(0.5F)) *
          static_cast<float>(kCell_m);
    }
    if (mesh.triangles.size() <= kMostSurfaceTriangles) break;
  }
  return mesh;
}

}  // namespace berth
