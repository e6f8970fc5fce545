#include "berth/fit/fit_rows.hpp"

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

namespace {

/// A reading nearer behind the robot than this may be its own surface.
constexpr float kLeastBackground_m = 0.06F;
/// Half of the window in which the outline's direction is measured.
constexpr int kWindow_px = 3;
/// The outline is walked across along rows where it is steeper than this, and along columns else.
constexpr double kLeastAcross = 0.7;

/// One of four directions in the image.
struct Way {
  int du;
  int dv;
};

class OutlineSearch {
 public:
  OutlineSearch(const Camera& camera, DepthView depth_m, const RobotImage& robot,
                const CameraEstimate& estimate, int step, const OutlineRowLimits& limits,
                std::vector<FitRow>& rows)
      : camera_(camera),
        depth_m_(depth_m),
        robot_(robot),
        estimate_(estimate),
        step_(step),
        limits_(limits),
        rows_(rows) {}

  OutlineCount run() {
    const PixelRect extent = clip(robot_.extent, camera_.width_px, camera_.height_px);
    for (int v = extent.v_begin; v < extent.v_end; ++v) {
      for (int u = extent.u_begin; u < extent.u_end; ++u) {
        if (!is_robot_at(u, v)) continue;
        for (const Way way : {Way{1, 0}, Way{-1, 0}, Way{0, 1}, Way{0, -1}}) look(u, v, way);
      }
    }
    return count_;
  }

 private:
  enum class Sensed { robot, behind, before, nothing };

  bool is_inside(int u, int v) const {
    return u >= 0 && v >= 0 && u < camera_.width_px && v < camera_.height_px;
  }
  bool is_robot_at(int u, int v) const { return is_robot(robot_.link_id(u, v)); }
  /// Whether the model has nothing at a pixel that stands near `z_m` or before it.
  bool is_open(int u, int v, float z_m) const {
    return robot_.link_id(u, v) == kNoLink || robot_.depth_m(u, v) > z_m + kLeastBackground_m;
  }

  Sensed sense(int u, int v, float z_m) const {
    const float reading_m = estimate_.corrected(depth_m_(u, v));
    if (std::isnan(reading_m)) return Sensed::nothing;
    if (reading_m > z_m + limits_.band_m) return Sensed::behind;
    return reading_m < z_m - limits_.band_m ? Sensed::before : Sensed::robot;
  }

  /// From the robot outwards, of length 1; none where the window leaves the image.
  std::optional<Eigen::Vector2d> direction(int u, int v, float z_m) const {
    if (!is_inside(u - kWindow_px, v - kWindow_px) || !is_inside(u + kWindow_px, v + kWindow_px)) {
      return {};
    }
    Eigen::Vector2d outwards = Eigen::Vector2d::Zero();
    for (int dv = -kWindow_px; dv <= kWindow_px; ++dv) {
      for (int du = -kWindow_px; du <= kWindow_px; ++du) {
        if (is_open(u + du, v + dv, z_m)) outwards += Eigen::Vector2d(du, dv);
      }
    }
    const double length = outwards.norm();
    if (!(length > 0)) return {};
    return outwards / length;
  }

  /// How many pixels the sensor's outline lies outside of the model's, along `way`; none where it
  /// is not found, or where something stands before it.
  std::optional<int> find_sensed(int u, int v, Way way, float z_m) const {
    const auto at = [&](int k) {
      const int ku = u + k * way.du;
      const int kv = v + k * way.dv;
      if (!is_inside(ku, kv)) return Sensed::before;
      // Inside the model's outline its own surface shows what is like the robot.
      const bool has_model = k < 0 && is_robot_at(ku, kv);
      return sense(ku, kv, has_model ? robot_.depth_m(ku, kv) : z_m);
    };
    int last = 0;
    while (at(last) != Sensed::robot) {
      if (at(last) == Sensed::before || --last < -limits_.reach_px) return {};
    }
    if (last == 0) {
      while (at(last + 1) == Sensed::robot) {
        if (++last > limits_.reach_px) return {};
      }
    }
    return at(last + 1) == Sensed::before ? std::nullopt : std::optional(last);
  }

  void look(int u, int v, Way way) {
    const float z_m = robot_.depth_m(u, v);
    if (!is_inside(u + way.du, v + way.dv) || !is_open(u + way.du, v + way.dv, z_m)) return;
    const auto normal = direction(u, v, z_m);
    if (!normal) return;
    const double across = normal->x() * way.du + normal->y() * way.dv;
    if (across < kLeastAcross) return;
    ++count_.places;
    const auto sensed_px = find_sensed(u, v, way, z_m);
    if (!sensed_px) return;
    ++count_.found;
    append(u + 0.5 * way.du, v + 0.5 * way.dv, robot_.link_id(u, v), z_m, *normal,
           *sensed_px * across);
  }

  void append(double u, double v, LinkId link, double z_m, const Eigen::Vector2d& normal,
              double sensed_px) {
    const double fx = camera_.fx_px;
    const double fy = camera_.fy_px;
    const double x = (u - camera_.cx_px) / fx;
    const double y = (v - camera_.cy_px) / fy;
    const double m_per_px = z_m / fx;
    FitRow& row = rows_.emplace_back();
    row.link = link;
    row.p_C_m = Eigen::Vector3d(x, y, 1) * z_m;
    row.residual_m = (sensed_px - estimate_.dilation_px / step_) * m_per_px;
    // The point's projection moves by (fx/z (dx - x dz), fy/z (dy - y dz)).
    row.per_move = -m_per_px / z_m *
                   Eigen::Vector3d(normal.x() * fx, normal.y() * fy,
                                   -(normal.x() * fx * x + normal.y() * fy * y));
    row.per_dilation = -m_per_px / step_;
  }

  const Camera& camera_;
  const DepthView depth_m_;
  const RobotImage& robot_;
  const CameraEstimate& estimate_;
  const int step_;
  const OutlineRowLimits& limits_;
  std::vector<FitRow>& rows_;
  OutlineCount count_;
};

}  // namespace

OutlineCount append_outline_rows(const Camera& camera, DepthView depth_m, const RobotImage& robot,
                                 const CameraEstimate& estimate, int step,
                                 const OutlineRowLimits& limits, std::vector<FitRow>& rows) {
  return OutlineSearch(camera, depth_m, robot, estimate, step, limits, rows).run();
}

}  // namespace berth
