#include "berth/calibration/solid_cells.hpp"

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

}  // namespace berth
