#include "berth/self_filter/grown_robot.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>

namespace berth {
namespace {

constexpr float kFar = std::numeric_limits<float>::infinity();

/// The rows of an ellipse with these half axes: half its width in each, from the centre row
/// outward.
void measure_disc(double radius_u_px, double radius_v_px, std::vector<int>& half_width_px) {
  half_width_px.resize(static_cast<std::size_t>(radius_v_px) + 1);
  for (std::size_t row = 0; row < half_width_px.size(); ++row) {
    const double share = static_cast<double>(row) / radius_v_px;
    // The margin keeps a pixel that is as far away as the radius itself.
    half_width_px[row] =
        static_cast<int>(radius_u_px * std::sqrt(std::max(0.0, 1 - share * share)) + 1e-9);
  }
}

/// Lowers the depths within a disc around (u, v) to `depth_m`.
void lower_disc(Image<float>& depths_m, int u, int v, const std::vector<int>& half_width_px,
                float depth_m) {
  const int reach = static_cast<int>(half_width_px.size()) - 1;
  const int last = std::min(depths_m.height() - 1, v + reach);
  for (int row = std::max(0, v - reach); row <= last; ++row) {
    const int half = half_width_px[std::abs(row - v)];
    float* begin = depths_m.row(row) + std::max(0, u - half);
    float* const end = depths_m.row(row) + std::min(depths_m.width() - 1, u + half) + 1;
    for (; begin < end; ++begin) *begin = std::min(*begin, depth_m);
  }
}

/// The pixels where the robot ends against the background or a deeper part of itself, or where its
/// surface turns away by more than 45 degrees: a calibration error moves the sensor's image of it
/// sideways, and there sideways means deeper. At the image's border the outline goes on outside.
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

/// The padding's disc is as large in the image as its length is at the pixel's depth.
void pad(const Camera& camera, int u, int v, float depth_m, double padding_m, GrownRobot& out) {
  if (padding_m <= 0) return;
  const double longest_px = std::max(camera.width_px, camera.height_px);
  measure_disc(std::min(longest_px, padding_m * camera.fx_px / depth_m),
               std::min(longest_px, padding_m * camera.fy_px / depth_m), out.half_width_px);
  lower_disc(out.padded_depth_m, u, v, out.half_width_px, depth_m);
}

void dilate(int u, int v, float depth_m, int dilation_px, GrownRobot& out) {
  if (dilation_px == 0) return;
  measure_disc(dilation_px, dilation_px, out.half_width_px);
  lower_disc(out.dilated_depth_m, u, v, out.half_width_px, depth_m);
}

}  // namespace

void grow_robot(const Camera& camera, const RobotImage& robot, const SelfFilterSettings& settings,
                GrownRobot& out) {
  out.padded_depth_m.resize(camera.width_px, camera.height_px, kFar);
  if (settings.dilation_px > 0) out.dilated_depth_m.resize(camera.width_px, camera.height_px, kFar);
  const Outline outline(camera, robot);
  for (int v = 0; v < camera.height_px; ++v) {
    for (int u = 0; u < camera.width_px; ++u) {
      if (!outline.holds(u, v)) continue;
      const float depth_m = robot.depth_m(u, v);
      pad(camera, u, v, depth_m, settings.padding_of(robot.link_id(u, v)), out);
      dilate(u, v, depth_m, settings.dilation_px, out);
    }
  }
}

}  // namespace berth
