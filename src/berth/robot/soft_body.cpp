#include "berth/robot/soft_body.hpp"

#include <algorithm>
#include <map>
#include <optional>
#include <stdexcept>

namespace berth {
namespace {

constexpr float kLeastColumn_m = 0.005F;
constexpr float kMostColumns = 400;
/// Of a column's width from its corner, so that it meets no edge of a mesh that was made on a grid.
constexpr float kMiddleX = 0.5371F;
constexpr float kMiddleY = 0.4763F;

/// Whether each edge is that of an even number of triangles, wherever in the list its corners
/// stand.
bool is_closed(const TriangleMesh& mesh) {
  using Corner = std::array<float, 3>;
  std::map<std::pair<Corner, Corner>, int> triangles;
  for (const std::array<std::uint32_t, 3>& triangle : mesh.triangles) {
    for (int i = 0; i < 3; ++i) {
      const Eigen::Vector3f& a = mesh.vertices_m[triangle[i]];
      const Eigen::Vector3f& b = mesh.vertices_m[triangle[(i + 1) % 3]];
      const auto [first, second] =
          std::minmax({Corner{a.x(), a.y(), a.z()}, Corner{b.x(), b.y(), b.z()}});
      ++triangles[{first, second}];
    }
  }
  return std::ranges::all_of(triangles, [](const auto& edge) { return edge.second % 2 == 0; });
}

/// Where the triangle crosses the line along z through (x, y), if it does.
std::optional<float> crossing_z_m(const std::array<Eigen::Vector3f, 3>& corners, float x, float y) {
  std::array<double, 3> area;
  for (int i = 0; i < 3; ++i) {
    const Eigen::Vector3f& a = corners[(i + 1) % 3];
    const Eigen::Vector3f& b = corners[(i + 2) % 3];
    area[i] = (double{b.x()} - a.x()) * (double{y} - a.y()) -
              (double{b.y()} - a.y()) * (double{x} - a.x());
  }
  const auto [least, most] = std::ranges::minmax(area);
  if (least < 0 && most > 0) return std::nullopt;
  const double sum = area[0] + area[1] + area[2];
  if (sum == 0) return std::nullopt;
  double z_m = 0;
  for (int i = 0; i < 3; ++i) z_m += area[i] / sum * corners[i].z();
  return static_cast<float>(z_m);
}

}  // namespace

SoftBody::SoftBody(std::size_t link, const TriangleMesh& mesh_L)
    : link_(link), box_L_m_(mesh_L.bounding_box_m()) {
  if (!is_closed(mesh_L)) {
    throw std::invalid_argument("the mesh is not closed; expected one that encloses a space");
  }
  const Eigen::Vector3f size_m = box_L_m_.sizes();
  column_m_ = std::max(kLeastColumn_m, size_m.head<2>().maxCoeff() / kMostColumns);
  columns_x_ = static_cast<int>(size_m.x() / column_m_) + 1;
  columns_y_ = static_cast<int>(size_m.y() / column_m_) + 1;
  std::vector<std::vector<float>> crossings_z_m(column_of(0, columns_y_));
  for (const std::array<std::uint32_t, 3>& triangle : mesh_L.triangles) {
    std::array<Eigen::Vector3f, 3> corners;
    Eigen::AlignedBox2f across;
    for (int i = 0; i < 3; ++i) {
      corners[i] = mesh_L.vertices_m[triangle[i]];
      across.extend(((corners[i] - box_L_m_.min()) / column_m_).head<2>());
    }
    const int last_x = std::min(columns_x_ - 1, static_cast<int>(across.max().x()));
    const int last_y = std::min(columns_y_ - 1, static_cast<int>(across.max().y()));
    for (int y = static_cast<int>(across.min().y()); y <= last_y; ++y) {
      for (int x = static_cast<int>(across.min().x()); x <= last_x; ++x) {
        const auto z_m = crossing_z_m(
            corners, box_L_m_.min().x() + column_m_ * (static_cast<float>(x) + kMiddleX),
            box_L_m_.min().y() + column_m_ * (static_cast<float>(y) + kMiddleY));
        if (z_m) crossings_z_m[column_of(x, y)].push_back(*z_m);
      }
    }
  }
  first_.push_back(0);
  for (std::vector<float>& column : crossings_z_m) {
    // It met an edge. Nothing is in it then: what is read there stays an obstacle.
    if (column.size() % 2 != 0) column.clear();
    std::ranges::sort(column);
    crossings_z_m_.insert(crossings_z_m_.end(), column.begin(), column.end());
    first_.push_back(static_cast<std::uint32_t>(crossings_z_m_.size()));
  }
}

std::size_t SoftBody::column_of(int x, int y) const {
  return static_cast<std::size_t>(y) * static_cast<std::size_t>(columns_x_) +
         static_cast<std::size_t>(x);
}

bool SoftBody::contains(const Eigen::Vector3f& p_L_m) const {
  if (!box_L_m_.contains(p_L_m)) return false;
  const Eigen::Vector3f at = (p_L_m - box_L_m_.min()) / column_m_;
  const std::size_t column = column_of(std::min(columns_x_ - 1, static_cast<int>(at.x())),
                                       std::min(columns_y_ - 1, static_cast<int>(at.y())));
  const auto first = crossings_z_m_.begin() + first_[column];
  const auto last = crossings_z_m_.begin() + first_[column + 1];
  return (std::lower_bound(first, last, p_L_m.z()) - first) % 2 != 0;
}

}  // namespace berth
