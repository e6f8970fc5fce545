#include "sim/winding_number.hpp"

#include <cmath>
#include <numbers>

namespace berth::sim {

double winding_number(const TriangleMesh& mesh, const Eigen::Vector3d& p_m) {
  double angle = 0;
  for (const auto& triangle : mesh.triangles) {
    const Eigen::Vector3d a = mesh.vertices_m[triangle[0]].cast<double>() - p_m;
    const Eigen::Vector3d b = mesh.vertices_m[triangle[1]].cast<double>() - p_m;
    const Eigen::Vector3d c = mesh.vertices_m[triangle[2]].cast<double>() - p_m;
    angle +=
        2 * std::atan2(a.dot(b.cross(c)), a.norm() * b.norm() * c.norm() + a.dot(b) * c.norm() +
                                              b.dot(c) * a.norm() + c.dot(a) * b.norm());
  }
  return angle / (4 * std::numbers::pi);
}

}  // namespace berth::sim
