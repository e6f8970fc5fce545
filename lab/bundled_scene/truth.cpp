#include "lab/bundled_scene/truth.hpp"

#include <fmt/format.h>

#include <limits>
#include <stdexcept>

namespace berth::lab {
namespace {

constexpr double kLeastClearance_m = 0.02;

std::vector<DistanceModel> make_models(const std::vector<PosedMesh>& meshes) {
  std::vector<DistanceModel> models;
  for (const PosedMesh& posed : meshes) models.push_back(make_distance_model(*posed.mesh));
  return models;
}

// Which of a link's triangles a pixel shows.
std::vector<bool> seen_triangles(const Image<SensorHit>& hits, int link, std::size_t triangles) {
  std::vector<bool> seen(triangles, false);
  for (const SensorHit& hit : hits.pixels())
    if (hit.mesh == static_cast<std::uint32_t>(link)) seen[hit.triangle] = true;
  return seen;
}

}  // namespace

TruthModels make_truth_models(const Scene& scene) {
  const PosedScene posed = pose_scene(scene, 0);
  return {make_models(posed.robot), make_models(posed.obstacles)};
}

std::vector<TruthRow> measure_truth(int frame, const PosedScene& posed, const TruthModels& models,
                                    const Image<SensorHit>& robot_alone) {
  const DistanceObjects obstacles = place(models.obstacles, posed.obstacles);
  std::vector<TruthRow> rows;
  for (int i = 0; i < kArmLinks; ++i) {
    const auto& [mesh, X_TL] = posed.robot[i];
    const double whole_m = least_distance_m(models.links[i], X_TL, obstacles);
    const DistanceModel seen =
        make_distance_model(*mesh, seen_triangles(robot_alone, i, mesh->triangle.size()));
    const double seen_m =
        seen ? least_distance_m(seen, X_TL, obstacles) : std::numeric_limits<double>::quiet_NaN();
    if (whole_m < kLeastClearance_m)
      throw std::runtime_error(
          fmt::format("frame {}: {} is {:.3f} m from an obstacle, expected {} m or more", frame,
                      arm_link_name(i), whole_m, kLeastClearance_m));
    rows.push_back({frame, arm_link_name(i), whole_m, seen_m});
  }
  return rows;
}

}  // namespace berth::lab
