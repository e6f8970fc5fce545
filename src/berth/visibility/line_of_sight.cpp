#include "berth/visibility/line_of_sight.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

namespace berth {
namespace {

/// What the pixel's fate says of its line of sight up to a point, if an obstacle nearer than
/// obstacle_up_to_m would stand before the point, and its robot or environment does or does not.
Sight sight_up_to(const SeenFrame& frame, Pixel pixel, float obstacle_up_to_m,
                  bool robot_is_before) {
  const PixelFate fate = frame.obstacles.fate(pixel.u, pixel.v);
  if (is_kept(fate) && frame.obstacles.depth_m(pixel.u, pixel.v) < obstacle_up_to_m) {
    return Sight::hidden_by_obstacles;
  }
  switch (fate) {
    case PixelFate::obstacle:
      return Sight::seen;
    case PixelFate::robot:
    case PixelFate::environment:
      return robot_is_before ? Sight::hidden_by_robot : Sight::seen;
    default:
      // Also before a background or what fills a hole: nobody saw that space free.
      return Sight::no_reading;
  }
}

/// The plane of a surface, that of all points p_C with normal_C . p_C = distance_m >= 0.
struct TangentPlane {
  Eigen::Vector3d normal_C;
  double distance_m;

  explicit TangentPlane(const LinkPoint& point) : normal_C(point.normal_C) {
    distance_m = normal_C.dot(point.p_C_m);
    if (distance_m >= 0) return;
    normal_C = -normal_C;
    distance_m = -distance_m;
  }

  /// Whether the pixel shows something in front of the plane by more than a pixel's width, which a
  /// curved surface does not reach. So it does wherever its line of sight never meets the plane.
  bool is_behind(const Camera& camera, Pixel pixel, double depth_m) const {
    const Eigen::Vector3d line_C((pixel.u - camera.cx_px) / camera.fx_px,
                                 (pixel.v - camera.cy_px) / camera.fy_px, 1);
    const double pixels_width_m = depth_m / std::min(camera.fx_px, camera.fy_px);
    return (depth_m + pixels_width_m) * normal_C.dot(line_C) < distance_m;
  }
};

}  // namespace

Sight sight_of_space(const SeenFrame& frame, const Eigen::Vector3d& p_C_m) {
  const std::optional<ImagePoint> at = project_into_image(frame.camera, p_C_m);
  if (!at) return Sight::outside_image;
  const Pixel pixel = pixel_of(*at);
  const auto depth_m = static_cast<float>(p_C_m.z());
  const float removed_from_m =
      frame.tolerance.least_reading_m(frame.robot.depth_m(pixel.u, pixel.v));
  return sight_up_to(frame, pixel, depth_m, removed_from_m <= depth_m);
}

SurfaceSight sight_of_surface(const SeenFrame& frame, const RobotImage& robot,
                              const LinkPoint& point) {
  const std::optional<ImagePoint> at = project_into_image(frame.camera, point.p_C_m);
  if (!at) return {Sight::outside_image, false};
  const TangentPlane plane(point);
  // Rounded down: both are above -1.
  const Pixel corner{static_cast<int>(at->u + 1) - 1, static_cast<int>(at->v + 1) - 1};
  Pixel shown;
  double shown_distance_px = 2;
  for (int i = 0; i < 4; ++i) {
    const Pixel pixel{std::clamp(corner.u + i % 2, 0, frame.camera.width_px - 1),
                      std::clamp(corner.v + i / 2, 0, frame.camera.height_px - 1)};
    const double distance_px = std::max(std::abs(pixel.u - at->u), std::abs(pixel.v - at->v));
    const LinkId id = robot.link_id(pixel.u, pixel.v);
    // Of another link the nearest pixel decides. The link's own far side lies next to the outline
    // where a pixel may show nothing.
    if (id == kNoLink || (id != point.id && distance_px > 0.5)) continue;
    if (plane.is_behind(frame.camera, pixel, robot.depth_m(pixel.u, pixel.v)))
      return {Sight::hidden_by_robot, false};
    if (id != point.id || distance_px >= shown_distance_px) continue;
    shown = pixel;
    shown_distance_px = distance_px;
  }
  if (shown == Pixel{}) return {Sight::no_reading, false};
  const float least_m = frame.tolerance.least_reading_m(robot.depth_m(shown.u, shown.v));
  const bool robot_was_before = frame.robot.depth_m(shown.u, shown.v) < least_m;
  return {sight_up_to(frame, shown, least_m, robot_was_before), true};
}

}  // namespace berth
