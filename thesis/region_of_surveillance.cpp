#include "thesis/region_of_surveillance.hpp"

#include <algorithm>
#include <cmath>

namespace berth {
namespace {

struct Range {
  int begin;
  int end;
};

/// Where the cube [x_lo - L, x_hi + L] x [z - L, z + L] projects to along one axis, in pixels from
/// the principal point times depth: its front is seen outside of the optical axis, its back inside.
Range project(double x_lo_px_m, double x_hi_px_m, double f_range_px_m, double z_m, double range_m,
              double principal_px, int size_px) {
  const double lower_px_m = x_lo_px_m - f_range_px_m;
  const double upper_px_m = x_hi_px_m + f_range_px_m;
  const double front_m = z_m - range_m;
  const double back_m = z_m + range_m;
  const double lower_px = lower_px_m / (lower_px_m > 0 ? back_m : front_m) + principal_px;
  const double upper_px = upper_px_m / (upper_px_m > 0 ? front_m : back_m) + principal_px;
  // A point on the border of two pixels belongs to both, whatever rounding says.
  constexpr double kBorderPx = 1e-6;
  const double last = size_px;
  return {static_cast<int>(std::clamp(std::floor(lower_px - kBorderPx), 0.0, last)),
          static_cast<int>(std::clamp(std::floor(upper_px + kBorderPx) + 1, 0.0, last))};
}

Range around(int pixel, double half_side_px, int size_px) {
  const double last = size_px;
  return {static_cast<int>(std::clamp(std::ceil(pixel - half_side_px), 0.0, last)),
          static_cast<int>(std::clamp(std::floor(pixel + half_side_px) + 1, 0.0, last))};
}

PixelRect whole_image(const Camera& camera) { return {0, 0, camera.width_px, camera.height_px}; }

}  // namespace

PixelRect region_of_surveillance(const Camera& camera, Pixel robot_pixel, float depth_m,
                                 double range_m) {
  if (depth_m <= range_m) return whole_image(camera);
  const double z_m = depth_m;
  const double cx_px = camera.corner_cx_px();
  const double cy_px = camera.corner_cy_px();
  const Range u = project((robot_pixel.u - cx_px) * z_m, (robot_pixel.u + 1 - cx_px) * z_m,
                          camera.fx_px * range_m, z_m, range_m, cx_px, camera.width_px);
  const Range v = project((robot_pixel.v - cy_px) * z_m, (robot_pixel.v + 1 - cy_px) * z_m,
                          camera.fy_px * range_m, z_m, range_m, cy_px, camera.height_px);
  return {u.begin, v.begin, u.end, v.end};
}

PixelRect flacco_region(const Camera& camera, Pixel robot_pixel, float depth_m, double range_m) {
  if (depth_m <= range_m) return whole_image(camera);
  const double range_per_depth = range_m / (depth_m - range_m);
  const Range u = around(robot_pixel.u, camera.fx_px * range_per_depth, camera.width_px);
  const Range v = around(robot_pixel.v, camera.fy_px * range_per_depth, camera.height_px);
  return {u.begin, v.begin, u.end, v.end};
}

PixelRect region_of_surveillance(SurveillanceRegion region, const Camera& camera, Pixel robot_pixel,
                                 float depth_m, double range_m) {
  switch (region) {
    case SurveillanceRegion::image:
      break;
    case SurveillanceRegion::cube_projection:
      return region_of_surveillance(camera, robot_pixel, depth_m, range_m);
    case SurveillanceRegion::flacco:
      return flacco_region(camera, robot_pixel, depth_m, range_m);
  }
  return whole_image(camera);
}

}  // namespace berth
