#include "lab/bundled_scene/mesh_distance.hpp"

#include <fcl/narrowphase/distance.h>

#include <algorithm>
#include <limits>

namespace berth::lab {

DistanceModel make_distance_model(const DrawnMesh& mesh) {
  return make_distance_model(mesh, std::vector<bool>(mesh.triangle.size(), true));
}

DistanceModel make_distance_model(const DrawnMesh& mesh, const std::vector<bool>& chosen) {
  if (std::find(chosen.begin(), chosen.end(), true) == chosen.end()) return nullptr;
  auto model = std::make_shared<fcl::BVHModel<fcl::OBBRSSd>>();
  model->beginModel();
  for (std::size_t i = 0; i < mesh.triangle.size(); ++i) {
    if (!chosen[i]) continue;
    const auto& [a, b, c] = mesh.triangle[i];
    model->addTriangle(mesh.vertex_m[a].cast<double>(), mesh.vertex_m[b].cast<double>(),
                       mesh.vertex_m[c].cast<double>());
  }
  model->endModel();
  model->computeLocalAABB();
  return model;
}

DistanceObjects place(const std::vector<DistanceModel>& models,
                      const std::vector<PosedMesh>& posed) {
  DistanceObjects objects;
  for (std::size_t i = 0; i < posed.size(); ++i) {
    objects.emplace_back(models[i], posed[i].X_TM);
    objects.back().computeAABB();
  }
  return objects;
}

double least_distance_m(const DistanceModel& model, const Pose& X_TM,
                        const DistanceObjects& obstacles) {
  fcl::CollisionObjectd link(model, X_TM);
  link.computeAABB();
  double least_m = std::numeric_limits<double>::infinity();
  for (const fcl::CollisionObjectd& obstacle : obstacles) {
    if (link.getAABB().distance(obstacle.getAABB()) >= least_m) continue;
    fcl::DistanceResultd result;
    least_m = std::min(least_m, fcl::distance(&link, &obstacle, fcl::DistanceRequestd(), result));
  }
  return least_m;
}

}  // namespace berth::lab
