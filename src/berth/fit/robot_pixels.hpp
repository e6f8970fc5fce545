// Inside berth only: the robot's pixels in an image, and statistics of what they show.
#pragma once

#include <algorithm>
#include <limits>
#include <vector>

#include "berth/types/camera.hpp"
#include "berth/types/robot_image.hpp"

namespace berth {

/// Farther from the model, along the optical axis, a reading is not the robot's.
inline constexpr float kRobotLike_m = 0.10F;

/// Whether it is a link of the robot, not environment.
constexpr bool is_robot(LinkId id) { return id != kNoLink && id != kEnvironmentLink; }

/// Calls take(u, v, link) for each pixel of an evaluated link.
template <class Take>
void each_robot_pixel(const Camera& camera, const RobotImage& robot, const Take& take,
                      int stride = 1) {
  const PixelRect extent = clip(robot.extent, camera.width_px, camera.height_px);
  for (int v = extent.v_begin; v < extent.v_end; v += stride) {
    for (int u = extent.u_begin; u < extent.u_end; u += stride) {
      const LinkId id = robot.link_id(u, v);
      if (is_robot(id)) take(u, v, id);
    }
  }
}

/// NaN of nothing. Reorders the values.
inline double quantile(std::vector<float>& values, double share) {
  if (values.empty()) return std::numeric_limits<double>::quiet_NaN();
  const auto place = static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), values.begin() + place, values.end());
  return values[static_cast<std::size_t>(place)];
}

}  // namespace berth
