#include "sim/mesh_distance.hpp"

#include <fcl/narrowphase/distance.h>

#include <algorithm>

#include "sim/fcl_mesh.hpp"

namespace berth::sim {

MeshTree build_mesh_tree(const TriangleMesh& mesh) {
  if (mesh.empty()) return nullptr;
  std::vector<fcl::Vector3d> vertices;
  for (const auto& vertex : mesh.vertices_m) vertices.push_back(vertex.cast<double>());
  std::vector<fcl::Triangle> triangles;
  for (const auto& [a, b, c] : mesh.triangles) triangles.emplace_back(a, b, c);
  auto tree = std::make_shared<FclMesh>();
  tree->beginModel(static_cast<int>(triangles.size()), static_cast<int>(vertices.size()));
  tree->addSubModel(vertices, triangles);
  tree->endModel();
  return tree;
}

std::vector<MeshTree> build_link_trees(const RobotModel& model) {
  std::vector<MeshTree> trees;
  for (const Link& link : model.links) {
    trees.push_back(link.role == LinkRole::ignored ? nullptr : build_mesh_tree(link.mesh_L));
  }
  return trees;
}

SurfacePair closest_points(const MeshTree& a, const Pose& X_WA, const MeshTree& b, const Pose& X_WB,
                           double less_than_m) {
  if (!a || !b) return {};
  fcl::DistanceResultd result;
  result.min_distance = std::min(less_than_m, result.min_distance);
  fcl::distance(a.get(), X_WA, b.get(), X_WB, fcl::DistanceRequestd(true), result);
  if (!(result.min_distance < less_than_m)) return {};
  return {std::max(0.0, result.min_distance), result.nearest_points[0], result.nearest_points[1]};
}

}  // namespace berth::sim
