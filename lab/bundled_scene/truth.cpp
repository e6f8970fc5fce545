#include "lab/bundled_scene/truth.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <stdexcept>

namespace berth::lab {
namespace {

constexpr double kLeastClearance_m = 0.02;

std::vector<sim::MeshTree> build_trees(const std::vector<sim::PosedMesh>& meshes) {
  std::vector<sim::MeshTree> trees;
  for (const sim::PosedMesh& posed : meshes) trees.push_back(sim::build_mesh_tree(*posed.mesh));
  return trees;
}

// Those of a link's triangles that a pixel shows.
TriangleMesh seen_part(const Image<sim::SurfaceHit>& hits, int link, const TriangleMesh& mesh) {
  std::vector<bool> is_seen(mesh.triangles.size(), false);
  for (const sim::SurfaceHit& hit : hits.pixels())
    if (hit.mesh == static_cast<std::uint32_t>(link)) is_seen[hit.triangle] = true;
  TriangleMesh seen{mesh.vertices_m, {}};
  for (std::size_t i = 0; i < is_seen.size(); ++i)
    if (is_seen[i]) seen.triangles.push_back(mesh.triangles[i]);
  return seen;
}

// Infinite for a tree that is null.
double least_distance_m(const sim::MeshTree& link, const Pose& X_TL, const PosedScene& posed,
                        const TruthTrees& trees) {
  double least_m = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < trees.obstacles.size(); ++i) {
    const double distance_m =
        sim::closest_points(link, X_TL, trees.obstacles[i], posed.obstacles[i].X_WM, least_m)
            .distance_m;
    least_m = std::min(least_m, distance_m);
  }
  return least_m;
}

}  // namespace

TruthTrees build_truth_trees(const Scene& scene) {
  const PosedScene posed = pose_scene(scene, 0);
  return {build_trees(posed.robot), build_trees(posed.obstacles)};
}

std::vector<TruthRow> measure_truth(int frame, const PosedScene& posed, const TruthTrees& trees,
                                    const Image<sim::SurfaceHit>& robot_alone) {
  std::vector<TruthRow> rows;
  for (int i = 0; i < sim::kArmLinks; ++i) {
    const auto& [mesh, X_TL] = posed.robot[i];
    const double whole_m = least_distance_m(trees.links[i], X_TL, posed, trees);
    const sim::MeshTree seen = sim::build_mesh_tree(seen_part(robot_alone, i, *mesh));
    const double seen_m = seen ? least_distance_m(seen, X_TL, posed, trees)
                               : std::numeric_limits<double>::quiet_NaN();
    if (whole_m < kLeastClearance_m)
      throw std::runtime_error(
          fmt::format("frame {}: {} is {:.3f} m from an obstacle, expected {} m or more", frame,
                      sim::arm_link_name(i), whole_m, kLeastClearance_m));
    rows.push_back({frame, sim::arm_link_name(i), whole_m, seen_m});
  }
  return rows;
}

}  // namespace berth::lab
