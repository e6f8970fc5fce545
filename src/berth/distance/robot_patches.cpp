#include "berth/distance/robot_patches.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>

#include "berth/space/serial_number.hpp"

namespace berth {
namespace {

constexpr int kChildren = LinkPatches::kChildren;

struct Triangle {
  std::array<Eigen::Vector3f, 3> corners_m;
  Eigen::Vector3f centre_m() const { return (corners_m[0] + corners_m[1] + corners_m[2]) / 3; }
};

/// Orders triangles so that each 16, 256, ... that follow each other lie side by side.
void sort_by_place(Triangle* begin, Triangle* end) {
  const auto count = end - begin;
  if (count <= kChildren) return;
  Eigen::AlignedBox3f box;
  for (const Triangle* t = begin; t != end; ++t) box.extend(t->centre_m());
  Eigen::Index axis;
  box.sizes().maxCoeff(&axis);
  std::ptrdiff_t unit = kChildren;
  while (unit * kChildren < count) unit *= kChildren;
  Triangle* middle = begin + std::max<std::ptrdiff_t>(1, (count / 2 + unit / 2) / unit) * unit;
  if (middle >= end) middle = begin + (count - 1) / unit * unit;
  std::nth_element(begin, middle, end, [axis](const Triangle& a, const Triangle& b) {
    return a.centre_m()[axis] < b.centre_m()[axis];
  });
  sort_by_place(begin, middle);
  sort_by_place(middle, end);
}

struct Hull {
  Eigen::Vector3f centre_m;
  Eigen::Vector3f axis;
  Eigen::Vector3f x;
  Eigen::Vector3f y;
  float half_height_m;
  float radius_m;
  float half_x_m;
  float half_y_m;
};

/// The direction that most of the surface faces, whatever its winding.
Eigen::Vector3d facing(const Triangle* begin, const Triangle* end) {
  Eigen::Matrix3d spread = Eigen::Matrix3d::Zero();
  for (const Triangle* t = begin; t != end; ++t) {
    const auto& [a, b, c] = t->corners_m;
    const Eigen::Vector3d normal = (b - a).cast<double>().cross((c - a).cast<double>());
    const double area = normal.norm();
    if (area > 0) spread += normal * normal.transpose() / area;
  }
  return Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(spread).eigenvectors().col(2);
}

/// The direction across m in which the corners lie farthest apart.
Eigen::Vector3d longest_across(const Eigen::Vector3d& m, const Triangle* begin,
                               const Triangle* end) {
  const Eigen::Vector3d x = m.unitOrthogonal();
  const Eigen::Vector3d y = m.cross(x);
  Eigen::Vector2d sum = Eigen::Vector2d::Zero();
  Eigen::Matrix2d spread = Eigen::Matrix2d::Zero();
  double count = 0;
  for (const Triangle* t = begin; t != end; ++t) {
    for (const auto& corner : t->corners_m) {
      const Eigen::Vector3d p = (corner - begin->corners_m[0]).cast<double>();
      const Eigen::Vector2d q(x.dot(p), y.dot(p));
      sum += q;
      spread += q * q.transpose();
      ++count;
    }
  }
  spread -= sum * sum.transpose() / count;
  const Eigen::Vector2d longest =
      Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d>(spread).eigenvectors().col(1);
  return longest.x() * x + longest.y() * y;
}

Hull bounding_hull(const Triangle* begin, const Triangle* end) {
  Hull hull;
  hull.axis = facing(begin, end).normalized().cast<float>();
  const Eigen::Vector3d m = hull.axis.cast<double>();
  hull.x = longest_across(m, begin, end).normalized().cast<float>();
  const Eigen::Vector3d x = hull.x.cast<double>();
  hull.y = m.cross(x).normalized().cast<float>();
  const Eigen::Vector3d y = hull.y.cast<double>();
  Eigen::AlignedBox3d box;
  for (const Triangle* t = begin; t != end; ++t) {
    for (const auto& corner : t->corners_m) {
      const Eigen::Vector3d p = corner.cast<double>();
      box.extend(Eigen::Vector3d(x.dot(p), y.dot(p), m.dot(p)));
    }
  }
  const Eigen::Vector3d centre = box.center();
  hull.centre_m = (centre.x() * x + centre.y() * y + centre.z() * m).cast<float>();
  Eigen::Vector3d half_m = Eigen::Vector3d::Zero();
  double radius_m = 0;
  for (const Triangle* t = begin; t != end; ++t) {
    for (const auto& corner : t->corners_m) {
      const Eigen::Vector3d v = (corner - hull.centre_m).cast<double>();
      half_m = half_m.cwiseMax(Eigen::Vector3d(x.dot(v), y.dot(v), m.dot(v)).cwiseAbs());
      radius_m = std::max(radius_m, (v - m.dot(v) * m).norm());
    }
  }
  // Above what the casts to float round away.
  const auto above = [](double half) { return static_cast<float>(half * (1 + 1e-6) + 1e-7); };
  hull.half_height_m = above(half_m.z());
  hull.radius_m = above(radius_m);
  hull.half_x_m = above(half_m.x());
  hull.half_y_m = above(half_m.y());
  return hull;
}

void push(const Hull& hull, PatchLevel& level) {
  for (int k = 0; k < 3; ++k) {
    level.centre_m[k].push_back(hull.centre_m[k]);
    level.axis[k].push_back(hull.axis[k]);
    level.x[k].push_back(hull.x[k]);
    level.y[k].push_back(hull.y[k]);
  }
  level.half_height_m.push_back(hull.half_height_m);
  level.radius_m.push_back(hull.radius_m);
  level.half_x_m.push_back(hull.half_x_m);
  level.half_y_m.push_back(hull.half_y_m);
}

/// The patches of `size` triangles each.
PatchLevel make_level(const std::vector<Triangle>& triangles, std::size_t size) {
  PatchLevel level;
  Hull last{};
  for (std::size_t i = 0; i < triangles.size(); i += size, ++level.count) {
    last = bounding_hull(triangles.data() + i,
                         triangles.data() + std::min(i + size, triangles.size()));
    push(last, level);
  }
  while (level.radius_m.size() % kChildren != 0) push(last, level);
  return level;
}

}  // namespace

LinkPatches build_link_patches(const TriangleMesh& mesh) {
  LinkPatches link;
  std::vector<Triangle> triangles;
  for (const auto& [a, b, c] : mesh.triangles) {
    triangles.push_back({{mesh.vertices_m[a], mesh.vertices_m[b], mesh.vertices_m[c]}});
  }
  link.triangle_count = static_cast<int>(triangles.size());
  if (triangles.empty()) return link;
  sort_by_place(triangles.data(), triangles.data() + triangles.size());
  std::size_t size = kChildren;
  do {
    link.levels.push_back(make_level(triangles, size));
    size *= kChildren;
  } while (link.levels.back().count > 1);
  while (triangles.size() % kChildren != 0) triangles.push_back(triangles.back());
  for (const Triangle& triangle : triangles) {
    for (int k = 0; k < 9; ++k) link.corners_m[k].push_back(triangle.corners_m[k / 3][k % 3]);
  }
  link.field = std::make_unique<const mesh::LinkField>(link.corners_m);
  return link;
}

std::shared_ptr<const RobotPatches> build_robot_patches(const RobotModel& model) {
  auto robot = std::make_shared<RobotPatches>();
  robot->serial_number = mesh::next_serial_number();
  for (const std::size_t index : model.evaluated_links) {
    robot->links.push_back(build_link_patches(model.links[index].mesh_L));
    robot->links.back().link = index;
  }
  return robot;
}

}  // namespace berth
