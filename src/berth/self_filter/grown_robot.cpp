#include "berth/self_filter/grown_robot.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace berth {
namespace {

constexpr float kFar = std::numeric_limits<float>::infinity();

/// Lowers the depths within an ellipse around (u, v) to `depth_m`.
void lower_disc(Image<float>& depths_m, int u, int v, double radius_u_px, double radius_v_px,
                float depth_m) {
  const int first = std::max(0, v - static_cast<int>(radius_v_px));
  const int last = std::min(depths_m.height() - 1, v + static_cast<int>(radius_v_px));
  for (int row = first; row <= last; ++row) {
    const double share = (row - v) / radius_v_px;
    // The margin keeps a pixel that is as far away as the radius itself.
    const int half =
        static_cast<int>(radius_u_px * std::sqrt(std::max(0.0, 1 - share * share)) + 1e-9);
    float* begin = depths_m.row(row) + std::max(0, u - half);
    float* const end = depths_m.row(row) + std::min(depths_m.width() - 1, u + half) + 1;
    for (; begin < end; ++begin) *begin = std::min(*begin, depth_m);
  }
}

/// A pixel of the robot with a neighbour that is not robot, or deeper by more than a surface is
/// from pixel to pixel. At the image's border the outline goes on outside.
class Outline {
 public:
  Outline(const Camera& camera, const RobotImage& robot)
      : robot_(robot), pixel_rad_(static_cast<float>(1 / std::max(camera.fx_px, camera.fy_px))) {}

  bool holds(int u, int v) const {
    const LinkId id = robot_.link_id(u, v);
    if (id == kNoLink || id == kEnvironmentLink) return false;
    return ends_at(u, v, u - 1, v) || ends_at(u, v, u + 1, v) || ends_at(u, v, u, v - 1) ||
           ends_at(u, v, u, v + 1);
  }

 private:
  bool ends_at(int u, int v, int nu, int nv) const {
    if (nu < 0 || nv < 0 || nu >= robot_.link_id.width() || nv >= robot_.link_id.height())
      return false;
    const LinkId id = robot_.link_id(nu, nv);
    return id == kNoLink || id == kEnvironmentLink ||
           robot_.depth_m(nu, nv) > robot_.depth_m(u, v) * (1 + pixel_rad_);
  }

  const RobotImage& robot_;
  float pixel_rad_;
};

}  // namespace

void grow_robot(const Camera& camera, const RobotImage& robot, const SelfFilterSettings& settings,
                GrownRobot& out) {
  out.padded_depth_m.resize(camera.width_px, camera.height_px, kFar);
  out.dilated_depth_m.resize(camera.width_px, camera.height_px, kFar);
  const Outline outline(camera, robot);
  for (int v = 0; v < camera.height_px; ++v) {
    for (int u = 0; u < camera.width_px; ++u) {
      if (!outline.holds(u, v)) continue;
      const float depth_m = robot.depth_m(u, v);
      const double padding_m = settings.padding_of(robot.link_id(u, v));
      if (padding_m > 0) {
        lower_disc(out.padded_depth_m, u, v, padding_m * camera.fx_px / depth_m,
                   padding_m * camera.fy_px / depth_m, depth_m);
      }
      if (settings.dilation_px > 0) {
        lower_disc(out.dilated_depth_m, u, v, settings.dilation_px, settings.dilation_px, depth_m);
      }
    }
  }
}

}  // namespace berth
