#include "berth/calibration/closed_surface.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace berth {
namespace {

constexpr float kFar = 1e12F;

/// Squared distances along one line to the nearest 0, plus what is there already: the lower
/// envelope of parabolas (Felzenszwalb and Huttenlocher, Distance transforms of sampled functions).
void transform_line(std::vector<float>& line, std::vector<int>& roots, std::vector<float>& starts,
                    std::vector<float>& out) {
  const int n = static_cast<int>(line.size());
  const auto value = [&](int i) { return line[static_cast<std::size_t>(i)]; };
  int k = 0;
  roots[0] = 0;
  starts[0] = -kFar;
  for (int q = 1; q < n; ++q) {
    float start = 0;
    while (true) {
      const int r = roots[static_cast<std::size_t>(k)];
      start = ((value(q) + static_cast<float>(q * q)) - (value(r) + static_cast<float>(r * r))) /
              static_cast<float>(2 * (q - r));
      if (k == 0 || start > starts[static_cast<std::size_t>(k)]) break;
      --k;
    }
    if (start > starts[static_cast<std::size_t>(k)]) ++k;
    roots[static_cast<std::size_t>(k)] = q;
    starts[static_cast<std::size_t>(k)] = k == 0 ? -kFar : start;
  }
  int at = 0;
  for (int q = 0; q < n; ++q) {
    while (at < k && starts[static_cast<std::size_t>(at + 1)] < static_cast<float>(q)) ++at;
    const int r = roots[static_cast<std::size_t>(at)];
    out[static_cast<std::size_t>(q)] = static_cast<float>((q - r) * (q - r)) + value(r);
  }
  line.swap(out);
}

/// Squared distances to the nearest 0 of a box of values that are 0 or kFar.
void transform(const Cell& size, std::vector<float>& values) {
  const std::array<std::ptrdiff_t, 3> stride = {1, size.x(),
                                                static_cast<std::ptrdiff_t>(size.x()) * size.y()};
  for (int axis = 0; axis < 3; ++axis) {
    const int n = size[axis];
    const int a = (axis + 1) % 3;
    const int b = (axis + 2) % 3;
    std::vector<float> line(static_cast<std::size_t>(n));
    std::vector<float> out(line.size());
    std::vector<float> starts(line.size());
    std::vector<int> roots(line.size());
    for (int i = 0; i < size[a]; ++i) {
      for (int j = 0; j < size[b]; ++j) {
        float* first = values.data() + i * stride[static_cast<std::size_t>(a)] +
                       j * stride[static_cast<std::size_t>(b)];
        const std::ptrdiff_t step = stride[static_cast<std::size_t>(axis)];
        for (int q = 0; q < n; ++q) line[static_cast<std::size_t>(q)] = first[q * step];
        transform_line(line, roots, starts, out);
        for (int q = 0; q < n; ++q) first[q * step] = line[static_cast<std::size_t>(q)];
      }
    }
  }
}

}  // namespace

std::vector<float> distance_field(const SolidCells& solid, int margin) {
  const Cell size = solid.size + Cell::Constant(2 * margin);
  std::vector<float> outside(static_cast<std::size_t>(size.prod()));
  std::vector<float> inside(outside.size());
  std::size_t i = 0;
  for (int z = 0; z < size.z(); ++z) {
    for (int y = 0; y < size.y(); ++y) {
      for (int x = 0; x < size.x(); ++x, ++i) {
        const bool is_solid = solid.contains(solid.first + Cell(x, y, z) - Cell::Constant(margin));
        outside[i] = is_solid ? 0 : kFar;
        inside[i] = is_solid ? kFar : 0;
      }
    }
  }
  transform(size, outside);
  transform(size, inside);
  for (i = 0; i < outside.size(); ++i) outside[i] = std::sqrt(outside[i]) - std::sqrt(inside[i]);
  return outside;
}

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
