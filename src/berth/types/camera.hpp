// The pinhole camera. This file is the one place that states the pixel convention.
#pragma once

#include <Eigen/Core>
#include <array>
#include <optional>

#include "berth/types/image.hpp"
#include "berth/types/pose.hpp"

namespace berth {

/// How a lens bends what a pinhole would show, as ROS and OpenCV have it.
struct Lens {
  /// Of the angle to the axis (Kannala and Brandt, "equidistant"), not of the radius (Brown and
  /// Conrady, "plumb_bob", "rational_polynomial").
  bool is_fisheye = false;
  /// k1, k2, p1, p2, k3, k4, k5, k6, or a fisheye's k1 to k4; 0 beyond those that are given.
  std::array<double, 8> coefficients{};

  bool operator==(const Lens&) const = default;
};

/// Intrinsics as in a ROS camera_info or in OpenCV: integer coordinates are pixel **centres**, so
/// pixel (u, v) covers [u - 1/2, u + 1/2] x [v - 1/2, v + 1/2]. The optical frame (REP 103) has z
/// forward, x right, y down. A point p_C projects to u = fx p.x / p.z + cx.
struct Camera {
  int width_px = 0;
  int height_px = 0;
  double fx_px = 0;
  double fy_px = 0;
  double cx_px = 0;
  double cy_px = 0;

  /// The thesis puts a pixel's **corner** at (u, v): its formulas hold with these two (Hirt 2.10
  /// to 2.18).
  double corner_cx_px() const { return cx_px + 0.5; }
  double corner_cy_px() const { return cy_px + 0.5; }
};

/// A point of the image in pixels, also between their centres.
struct ImagePoint {
  double u;
  double v;
};

/// The point at the depth z of a pixel, in C.
inline Eigen::Vector3d point_at(const Camera& camera, int u, int v, double z_m) {
  return {(u - camera.cx_px) / camera.fx_px * z_m, (v - camera.cy_px) / camera.fy_px * z_m, z_m};
}

/// Where a point before the camera (z > 0) projects to, in or beside the image.
inline ImagePoint project(const Camera& camera, const Eigen::Vector3d& p_C_m) {
  return {camera.fx_px * p_C_m.x() / p_C_m.z() + camera.cx_px,
          camera.fy_px * p_C_m.y() / p_C_m.z() + camera.cy_px};
}

/// The same; none beside the image's pixels and behind the camera.
inline std::optional<ImagePoint> project_into_image(const Camera& camera,
                                                    const Eigen::Vector3d& p_C_m) {
  if (!(p_C_m.z() > 0)) return std::nullopt;
  const ImagePoint at = project(camera, p_C_m);
  const bool is_inside =
      at.u >= -0.5 && at.u < camera.width_px - 0.5 && at.v >= -0.5 && at.v < camera.height_px - 0.5;
  return is_inside ? std::optional(at) : std::nullopt;
}

/// The pixel that a point of the image lies in.
inline Pixel pixel_of(const ImagePoint& at) {
  return {static_cast<int>(at.u + 0.5), static_cast<int>(at.v + 0.5)};
}

/// The pixel that a point projects into; none outside of the image and behind the camera.
inline std::optional<Pixel> pixel_of(const Camera& camera, const Eigen::Vector3d& p_C_m) {
  const std::optional<ImagePoint> at = project_into_image(camera, p_C_m);
  return at ? std::optional(pixel_of(*at)) : std::nullopt;
}

}  // namespace berth
