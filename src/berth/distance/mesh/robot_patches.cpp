#include "berth/distance/mesh/robot_patches.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <numeric>

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

struct Cylinder {
  Eigen::Vector3f centre_m;
  Eigen::Vector3f axis;
  float half_height_m;
  float radius_m;
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

Cylinder bounding_cylinder(const Triangle* begin, const Triangle* end) {
  Cylinder cylinder;
  cylinder.axis = facing(begin, end).normalized().cast<float>();
  const Eigen::Vector3d m = cylinder.axis.cast<double>();
  const Eigen::Vector3d x = m.unitOrthogonal();
  const Eigen::Vector3d y = m.cross(x);
  Eigen::AlignedBox3d box;
  for (const Triangle* t = begin; t != end; ++t) {
    for (const auto& corner : t->corners_m) {
      const Eigen::Vector3d p = corner.cast<double>();
      box.extend(Eigen::Vector3d(x.dot(p), y.dot(p), m.dot(p)));
    }
  }
  const Eigen::Vector3d centre = box.center();
  cylinder.centre_m = (centre.x() * x + centre.y() * y + centre.z() * m).cast<float>();
  double half_height_m = 0;
  double radius_m = 0;
  for (const Triangle* t = begin; t != end; ++t) {
    for (const auto& corner : t->corners_m) {
      const Eigen::Vector3d v = (corner - cylinder.centre_m).cast<double>();
      half_height_m = std::max(half_height_m, std::abs(m.dot(v)));
      radius_m = std::max(radius_m, (v - m.dot(v) * m).norm());
    }
  }
  // Above what the casts to float round away.
  constexpr double kAbove = 1 + 1e-6;
  cylinder.half_height_m = static_cast<float>(half_height_m * kAbove + 1e-7);
  cylinder.radius_m = static_cast<float>(radius_m * kAbove + 1e-7);
  return cylinder;
}

void push(const Cylinder& cylinder, PatchLevel& level) {
  for (int k = 0; k < 3; ++k) {
    level.centre_m[k].push_back(cylinder.centre_m[k]);
    level.axis[k].push_back(cylinder.axis[k]);
  }
  level.half_height_m.push_back(cylinder.half_height_m);
  level.radius_m.push_back(cylinder.radius_m);
}

/// The patches of `size` triangles each.
PatchLevel make_level(const std::vector<Triangle>& triangles, std::size_t size) {
  PatchLevel level;
  Cylinder last{};
  for (std::size_t i = 0; i < triangles.size(); i += size, ++level.count) {
    last = bounding_cylinder(triangles.data() + i,
                             triangles.data() + std::min(i + size, triangles.size()));
    push(last, level);
  }
  while (level.radius_m.size() % kChildren != 0) push(last, level);
  return level;
}

LinkPatches make_link(const TriangleMesh& mesh) {
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
  return link;
}

}  // namespace

std::shared_ptr<const RobotPatches> build_robot_patches(const RobotModel& model) {
  auto robot = std::make_shared<RobotPatches>();
  for (const std::size_t index : model.evaluated_links) {
    robot->links.push_back(make_link(model.links[index].mesh_L));
    robot->links.back().link = index;
  }
  return robot;
}

}  // namespace berth
