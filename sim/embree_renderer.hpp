// A second opinion on RobotRenderer: Embree's ray caster.
#pragma once

#include "berth/robot/kinematics.hpp"
#include "berth/robot/robot_model.hpp"
#include "sim/ray_caster.hpp"
#include "sim/ray_hit.hpp"

namespace berth::sim {

/// One robot in one pose, seen by one camera.
class EmbreeRenderer {
 public:
  /// `pose` holds all of the model's links; X_BC is the camera's pose in the root link's frame.
  /// Throws std::runtime_error where Embree fails.
  EmbreeRenderer(const RobotModel& model, const RobotPose& pose, const Pose& X_BC,
                 const Camera& camera)
      : rays_(posed_links(model, pose, ids_), X_BC, camera) {}

  /// What the ray through (u, v), in pixels, meets first.
  RayHit hit(double u, double v) const {
    const SurfaceHit hit = rays_.hit(u, v);
    if (hit.mesh == kNoMesh) return {};
    return {ids_[hit.mesh], hit.depth_m, hit.triangle};
  }

 private:
  /// Those that are seen, and sets their `ids`.
  static std::vector<PosedMesh> posed_links(const RobotModel& model, const RobotPose& pose,
                                            std::vector<LinkId>& ids) {
    std::vector<PosedMesh> links;
    for (std::size_t i = 0; i < model.links.size(); ++i) {
      const Link& link = model.links[i];
      if (link.role == LinkRole::ignored || link.mesh_L.empty()) continue;
      links.push_back({&link.mesh_L, pose.X_BL[i]});
      ids.push_back(link.id);
    }
    return links;
  }

  std::vector<LinkId> ids_;
  RayCaster rays_;
};

}  // namespace berth::sim
