#include "berth/robot/surface.hpp"

#include <map>
#include <tuple>

namespace berth {
namespace {

struct Corners {
  Eigen::Vector3d a_m;
  Eigen::Vector3d b_m;
  Eigen::Vector3d c_m;

  /// Twice the area, along the normal.
  Eigen::Vector3d double_area_m2() const { return (b_m - a_m).cross(c_m - a_m); }
};

Corners corners_of(const TriangleMesh& mesh, const std::array<std::uint32_t, 3>& triangle) {
  return {mesh.vertices_m[triangle[0]].cast<double>(), mesh.vertices_m[triangle[1]].cast<double>(),
          mesh.vertices_m[triangle[2]].cast<double>()};
}

Eigen::Vector3d mean_vertex_m(const TriangleMesh& mesh) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (const auto& vertex : mesh.vertices_m) sum += vertex.cast<double>();
  return mesh.vertices_m.empty() ? sum : sum / static_cast<double>(mesh.vertices_m.size());
}

}  // namespace

Eigen::Vector3d surface_centre_m(const TriangleMesh& mesh) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  double weights = 0;
  for (const auto& triangle : mesh.triangles) {
    const Corners corners = corners_of(mesh, triangle);
    const double weight = corners.double_area_m2().norm();
    sum += weight * (corners.a_m + corners.b_m + corners.c_m) / 3;
    weights += weight;
  }
  return weights > 0 ? sum / weights : mean_vertex_m(mesh);
}

TriangleMesh scaled(const TriangleMesh& mesh, double scale) {
  const Eigen::Vector3d centre_m = surface_centre_m(mesh);
  TriangleMesh larger = mesh;
  for (Eigen::Vector3f& vertex : larger.vertices_m) {
    vertex = (centre_m + scale * (vertex.cast<double>() - centre_m)).cast<float>();
  }
  return larger;
}

std::vector<Eigen::Vector3f> vertex_normals(const TriangleMesh& mesh) {
  // Files repeat a position for each triangle that has it.
  using Position = std::tuple<float, float, float>;
  const auto position_of = [&](std::uint32_t vertex) {
    const Eigen::Vector3f& p = mesh.vertices_m[vertex];
    return Position(p.x(), p.y(), p.z());
  };
  std::map<Position, Eigen::Vector3d> sums;
  for (const auto& triangle : mesh.triangles) {
    const Eigen::Vector3d normal = corners_of(mesh, triangle).double_area_m2();
    for (const std::uint32_t vertex : triangle) {
      sums.try_emplace(position_of(vertex), Eigen::Vector3d::Zero()).first->second += normal;
    }
  }
  std::vector<Eigen::Vector3f> normals(mesh.vertices_m.size(), Eigen::Vector3f::Zero());
  for (std::uint32_t i = 0; i < normals.size(); ++i) {
    const auto sum = sums.find(position_of(i));
    if (sum != sums.end()) normals[i] = sum->second.stableNormalized().cast<float>();
  }
  return normals;
}

RobotModel robot_region(const RobotModel& model, double scale) {
  RobotModel region = model;
  for (Link& link : region.links) {
    if (link.role == LinkRole::evaluated) {
      link.mesh_L = scaled(link.mesh_L, scale);
    } else {
      link.role = LinkRole::ignored;
    }
  }
  return region;
}

}  // namespace berth
