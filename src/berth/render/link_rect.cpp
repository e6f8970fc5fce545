#include "berth/render/link_rect.hpp"

#include <algorithm>
#include <cmath>

namespace berth {
namespace {

// Nearer than this a projection is of no use: such a corner counts as one beside the camera.
constexpr double kLeastDepth_m = 1e-3;

int clamp_to(double value, int limit) {
  return static_cast<int>(std::clamp(value, 0.0, static_cast<double>(limit)));
}

}  // namespace

PixelRect project_box(const Eigen::AlignedBox3f& box_L, const Pose& X_CL, const Camera& camera) {
  Eigen::AlignedBox2d bounds_px;
  int behind = 0;
  int too_near = 0;
  for (int corner = 0; corner < 8; ++corner) {
    const auto which = static_cast<Eigen::AlignedBox3f::CornerType>(corner);
    const Eigen::Vector3d p_C = X_CL * box_L.corner(which).cast<double>();
    if (p_C.z() <= 0) ++behind;
    if (p_C.z() < kLeastDepth_m) {
      ++too_near;
      continue;
    }
    const ImagePoint at = project(camera, p_C);
    bounds_px.extend(Eigen::Vector2d(at.u, at.v));
  }
  if (behind == 8) return {};
  if (too_near > 0) return {0, 0, camera.width_px, camera.height_px};
  // One pixel more on each side: the rays are single precision.
  return {clamp_to(std::floor(bounds_px.min().x()) - 1, camera.width_px),
          clamp_to(std::floor(bounds_px.min().y()) - 1, camera.height_px),
          clamp_to(std::ceil(bounds_px.max().x()) + 2, camera.width_px),
          clamp_to(std::ceil(bounds_px.max().y()) + 2, camera.height_px)};
}

}  // namespace berth
