#include "berth/self_filter/drop_soft.hpp"

#include "berth/render/link_rect.hpp"

namespace berth {

void pose_soft_bodies(const RobotModel& model, const RobotPose& pose, const Pose& X_BC,
                      std::vector<PosedSoftBody>& out) {
  out.clear();
  for (const SoftBody& body : model.soft_bodies) {
    out.push_back({&body, pose.X_BL[body.link()].inverse() * X_BC});
  }
}

void drop_soft(const Camera& camera, const std::vector<PosedSoftBody>& bodies, ObstacleImage& out) {
  for (const auto& [body, X_LC] : bodies) {
    const PixelRect rect = project_box(body->box_L_m(), X_LC.inverse(), camera);
    for (int v = rect.v_begin; v < rect.v_end; ++v) {
      for (int u = rect.u_begin; u < rect.u_end; ++u) {
        PixelFate& fate = out.fate(u, v);
        if (!is_kept(fate)) continue;
        const Eigen::Vector3d p_L_m = X_LC * point_at(camera, u, v, out.depth_m(u, v));
        if (!body->contains(p_L_m.cast<float>())) continue;
        --out.count[static_cast<std::size_t>(fate)];
        ++out.count[static_cast<std::size_t>(PixelFate::soft)];
        fate = PixelFate::soft;
        out.depth_m(u, v) = kNoDepth;
      }
    }
  }
}

}  // namespace berth
