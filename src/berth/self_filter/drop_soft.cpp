#include "berth/self_filter/drop_soft.hpp"

namespace berth {
namespace {

/// The pixels that may show the box; all of them where a part of it is not before the camera.
PixelRect pixels_of(const Camera& camera, const Pose& X_CL, const Eigen::AlignedBox3f& box_L_m) {
  constexpr double kNear_m = 0.01;
  const PixelRect all{0, 0, camera.width_px, camera.height_px};
  Eigen::AlignedBox2d image;
  for (int i = 0; i < 8; ++i) {
    const auto corner = static_cast<Eigen::AlignedBox3f::CornerType>(i);
    const Eigen::Vector3d p_C_m = X_CL * box_L_m.corner(corner).cast<double>();
    if (p_C_m.z() < kNear_m) return all;
    const ImagePoint at = project(camera, p_C_m);
    image.extend(Eigen::Vector2d(at.u, at.v));
  }
  // Far beside the image a number of pixels need not be an int.
  const Eigen::AlignedBox2d inside = image.intersection(Eigen::AlignedBox2d(
      Eigen::Vector2d(-1, -1), Eigen::Vector2d(camera.width_px, camera.height_px)));
  if (inside.isEmpty()) return {};
  return clip({static_cast<int>(inside.min().x()), static_cast<int>(inside.min().y()),
               static_cast<int>(inside.max().x()) + 2, static_cast<int>(inside.max().y()) + 2},
              camera.width_px, camera.height_px);
}

}  // namespace

void pose_soft_bodies(const RobotModel& model, const RobotPose& pose, const Pose& X_BC,
                      std::vector<PosedSoftBody>& out) {
  out.clear();
  for (const SoftBody& body : model.soft_bodies) {
    out.push_back({&body, pose.X_BL[body.link()].inverse() * X_BC});
  }
}

void drop_soft(const Camera& camera, const std::vector<PosedSoftBody>& bodies, ObstacleImage& out) {
  for (const auto& [body, X_LC] : bodies) {
    const PixelRect rect = pixels_of(camera, X_LC.inverse(), body->box_L_m());
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
