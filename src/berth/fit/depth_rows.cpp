#include "berth/fit/depth_rows.hpp"

#include <Eigen/Geometry>
#include <cmath>
#include <optional>

#include "berth/fit/robot_pixels.hpp"

namespace berth {
namespace {

/// At grazing angles a reading's depth says little, and sensors are wrong.
constexpr double kLeastCosine = 0.25;

Eigen::Vector3d ray_of(const Camera& camera, int u, int v) {
  return {(u - camera.cx_px) / camera.fx_px, (v - camera.cy_px) / camera.fy_px, 1};
}

/// The normal of the drawn surface at a pixel, from its four neighbours; none at a link's outline.
std::optional<Eigen::Vector3d> normal_at(const Camera& camera, const RobotImage& robot, int u,
                                         int v) {
  const LinkId id = robot.link_id(u, v);
  const auto point = [&](int du, int dv) -> Eigen::Vector3d {
    return ray_of(camera, u + du, v + dv) * double{robot.depth_m(u + du, v + dv)};
  };
  if (u < 1 || v < 1 || u + 1 >= camera.width_px || v + 1 >= camera.height_px) return {};
  if (robot.link_id(u - 1, v) != id || robot.link_id(u + 1, v) != id ||
      robot.link_id(u, v - 1) != id || robot.link_id(u, v + 1) != id) {
    return {};
  }
  const Eigen::Vector3d normal = (point(1, 0) - point(-1, 0)).cross(point(0, 1) - point(0, -1));
  const double length = normal.norm();
  if (!(length > 0)) return {};
  return normal / length;
}

}  // namespace

void append_depth_rows(const Camera& camera, DepthView depth_m, const RobotImage& robot,
                       const CameraEstimate& estimate, const DepthRowLimits& limits,
                       std::vector<FitRow>& rows) {
  const PixelRect extent = clip(robot.extent, camera.width_px, camera.height_px);
  for (int v = extent.v_begin; v < extent.v_end; v += limits.stride) {
    for (int u = extent.u_begin; u < extent.u_end; u += limits.stride) {
      const LinkId id = robot.link_id(u, v);
      if (!is_robot(id)) continue;
      const float reading_m = depth_m(u, v);
      const float corrected_m = estimate.corrected(reading_m);
      const float model_m = robot.depth_m(u, v);
      if (!(std::abs(corrected_m - model_m) <= limits.cut_m)) continue;
      const auto normal = normal_at(camera, robot, u, v);
      if (!normal) continue;
      const Eigen::Vector3d ray = ray_of(camera, u, v);
      const double along = normal->dot(ray);
      if (std::abs(along) < kLeastCosine * ray.norm()) continue;
      FitRow& row = rows.emplace_back();
      row.link = id;
      row.p_C_m = ray * double{model_m};
      row.residual_m = along * (double{corrected_m} - model_m);
      row.per_move = -*normal;
      row.per_depth_offset = along;
      row.per_depth_scale = along * reading_m;
    }
  }
}

}  // namespace berth
