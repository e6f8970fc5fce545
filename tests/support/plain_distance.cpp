#include "tests/support/plain_distance.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "berth/distance/convex_pair.hpp"
#include "sim/plain_aging.hpp"
#include "sim/plain_closing.hpp"
#include "sim/plain_hiding.hpp"

namespace berth::testing {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// Floats, as the images are: what is rounded down may hang on a last bit.
float own_of_reading(const MeshWorldView& view, const SpaceSettings& settings, int u, int v) {
  const float sensed_m = view.sensor_depth_m(u, v);
  const float obstacle_m = view.obstacles.depth_m(u, v);
  const auto margin_m = static_cast<float>(settings.free_space_margin_m);
  const auto behind_m = static_cast<float>(settings.behind_robot_m);
  const PixelFate fate = view.obstacles.fate(u, v);
  if (fate == PixelFate::background) {
    return std::isnan(sensed_m) ? 0 : std::min(obstacle_m - margin_m, sensed_m + behind_m);
  }
  if (is_kept(fate)) return obstacle_m - margin_m;
  if (fate == PixelFate::environment) {
    const bool has_back = view.environment_back_m.width() > 0;
    const float back_m = has_back ? view.environment_back_m(u, v) : kNoDepth;
    const float solid_m = std::fmin(back_m, sensed_m + behind_m);
    return std::isnan(back_m) ? sensed_m - margin_m : std::fmax(sensed_m - margin_m, solid_m);
  }
  const bool is_robot = fate == PixelFate::robot || fate == PixelFate::padding;
  return is_robot ? sensed_m + behind_m : sensed_m - margin_m;
}

float own_free_depth(const MeshWorldView& view, const SpaceSettings& settings, int u, int v) {
  const DepthImage& S = view.sensor_depth_m;
  const bool is_hole = view.obstacles.fate(u, v) == PixelFate::hole;
  if (!is_hole && (!std::isnan(S(u, v)) || !std::isnan(view.obstacles.depth_m(u, v)))) {
    return own_of_reading(view, settings, u, v);
  }
  return settings.no_reading == NoReading::free ? HUGE_VALF : 0;
}

/// What each pixel frees by itself, and beyond what is too small to hide anybody.
DepthImage closed_free_depth(const MeshWorldView& view, const SpaceSettings& settings) {
  DepthImage own_m(view.camera.width_px, view.camera.height_px, 0);
  for (int v = 0; v < own_m.height(); ++v) {
    for (int u = 0; u < own_m.width(); ++u) {
      const float freed_m = own_free_depth(view, settings, u, v);
      if (freed_m > 0) own_m(u, v) = sim::plainly_counted(freed_m);
    }
  }
  const double told_m = sim::plainly_told_m(settings, view.camera);
  own_m = sim::plainly_freed_beside_robot(view.camera, view.sensor_depth_m, view.obstacles.depth_m,
                                          view.obstacles.fate, own_m, told_m);
  return sim::plainly_closed(view.camera, own_m, told_m);
}

std::optional<Pixel> plain_pixel(const Camera& camera, const Eigen::Vector3d& p_C) {
  if (p_C.z() <= 0) return std::nullopt;
  const double u = std::floor(p_C.x() / p_C.z() * camera.fx_px + camera.cx_px + 0.5);
  const double v = std::floor(p_C.y() / p_C.z() * camera.fy_px + camera.cy_px + 0.5);
  if (u < 0 || v < 0 || u >= camera.width_px || v >= camera.height_px) return std::nullopt;
  return Pixel{static_cast<int>(u), static_cast<int>(v)};
}

}  // namespace

Image<double> plain_free_depth(const MeshWorldView& view, const SpaceSettings& settings) {
  Image<double> free_m(view.camera.width_px, view.camera.height_px, 0);
  const DepthImage aged_m =
      sim::plainly_aged(view.camera, view.sensor_depth_m, closed_free_depth(view, settings),
                        view.environment_front_m, settings.obstacle_speed_m_s * view.age_s);
  std::ranges::copy(aged_m.pixels(), free_m.pixels().begin());
  return free_m;
}

PlainSpace::PlainSpace(const MeshWorld& world) : world_(world) {
  for (const MeshWorldView& view : world.views) {
    free_m_.push_back(plain_free_depth(view, world.settings));
    hidden_from_m_.push_back(sim::plainly_hidden_from(
        view.camera, view.sensor_depth_m, view.obstacles.depth_m, view.obstacles.fate,
        closed_free_depth(view, world.settings), world.settings));
  }
}

bool PlainSpace::is_reading(std::size_t k, const Eigen::Vector3d& p_B, double slack_m) const {
  const MeshWorldView& view = world_.views[k];
  const Eigen::Vector3d p_C = view.X_BC.inverse() * p_B;
  if (p_C.z() <= 0) return false;
  // A pixel's neighbour counts where the point lies on the border between them.
  const double slack_px = slack_m / p_C.z() * view.camera.fx_px;
  const double u = p_C.x() / p_C.z() * view.camera.fx_px + view.camera.cx_px;
  const double v = p_C.y() / p_C.z() * view.camera.fy_px + view.camera.cy_px;
  for (const double du : {-slack_px, slack_px}) {
    for (const double dv : {-slack_px, slack_px}) {
      const double x = std::floor(u + du + 0.5);
      const double y = std::floor(v + dv + 0.5);
      if (x < 0 || y < 0 || x >= view.camera.width_px || y >= view.camera.height_px) continue;
      const double near_m = view.obstacles.depth_m(static_cast<int>(x), static_cast<int>(y));
      if (near_m - slack_m <= p_C.z() &&
          p_C.z() <= near_m + world_.settings.surface_thickness_m + slack_m) {
        return true;
      }
    }
  }
  return false;
}

bool PlainSpace::is_behind(std::size_t k, const Eigen::Vector3d& p_B) const {
  const MeshWorldView& view = world_.views[k];
  const Eigen::Vector3d p_C = view.X_BC.inverse() * p_B;
  const auto pixel = plain_pixel(view.camera, p_C);
  return pixel && p_C.z() > hidden_from_m_[k](pixel->u, pixel->v) &&
         p_C.z() < sim::plainly_hidden_to(view.environment_front_m, *pixel);
}

bool PlainSpace::is_free(std::size_t k, const Eigen::Vector3d& p_B) const {
  const MeshWorldView& view = world_.views[k];
  const Eigen::Vector3d p_C = view.X_BC.inverse() * p_B;
  const auto pixel = plain_pixel(view.camera, p_C);
  return pixel && p_C.z() < free_m_[k](pixel->u, pixel->v);
}

bool PlainSpace::is_hidden(const Eigen::Vector3d& p_B) const {
  for (std::size_t k = 0; k < world_.views.size(); ++k) {
    if (!is_behind(k, p_B)) continue;
    bool is_seen_free = false;
    for (std::size_t j = 0; j < world_.views.size(); ++j) is_seen_free |= j != k && is_free(j, p_B);
    if (!is_seen_free) return true;
  }
  return false;
}

namespace {

std::vector<std::array<Eigen::Vector3d, 3>> triangles_in(const MeshWorld& world, std::size_t link,
                                                         const Pose& X_FB) {
  const TriangleMesh& mesh = world.model.links[link].mesh_L;
  const Pose X_FL = X_FB * world.pose.X_BL[link];
  std::vector<std::array<Eigen::Vector3d, 3>> triangles;
  for (const auto& corners : mesh.triangles) {
    auto& triangle = triangles.emplace_back();
    for (int i = 0; i < 3; ++i) {
      triangle[i] = X_FL * mesh.vertices_m[corners[i]].cast<double>();
    }
  }
  return triangles;
}

/// A ball around points, about their middle.
struct Ball {
  Eigen::Vector3d centre_m = Eigen::Vector3d::Zero();
  double radius_m = 0;
};

template <std::size_t count>
Ball ball_of(const std::array<Eigen::Vector3d, count>& points_m) {
  Ball ball;
  for (const auto& p : points_m) ball.centre_m += p / count;
  for (const auto& p : points_m) {
    ball.radius_m = std::max(ball.radius_m, (p - ball.centre_m).norm());
  }
  return ball;
}

}  // namespace

double plain_pixel_distance(const MeshWorld& world, std::size_t link, bool to_shadow,
                            double range_m) {
  constexpr double kFar_m = 20;
  double least_m = range_m;
  for (const MeshWorldView& view : world.views) {
    const auto triangles = triangles_in(world, link, view.X_BC.inverse());
    std::vector<Ball> balls;
    for (const auto& triangle : triangles) balls.push_back(ball_of(triangle));
    for (int v = 0; v < view.camera.height_px; ++v) {
      for (int u = 0; u < view.camera.width_px; ++u) {
        const double near_m = view.obstacles.depth_m(u, v);
        if (std::isnan(near_m)) continue;
        std::array<Eigen::Vector3d, 8> chunk_m;
        for (int i = 0; i < 8; ++i) {
          const double z = !(i & 4)    ? near_m
                           : to_shadow ? kFar_m
                                       : near_m + world.settings.surface_thickness_m;
          chunk_m[i] = {z * (u + (i & 1) - 0.5 - view.camera.cx_px) / view.camera.fx_px,
                        z * (v + (i >> 1 & 1) - 0.5 - view.camera.cy_px) / view.camera.fy_px, z};
        }
        const Ball around = ball_of(chunk_m);
        for (std::size_t i = 0; i < triangles.size(); ++i) {
          const double bound_m =
              (around.centre_m - balls[i].centre_m).norm() - around.radius_m - balls[i].radius_m;
          if (bound_m >= least_m) continue;
          least_m = std::min(least_m, mesh::closest_points(triangles[i], chunk_m).distance_m);
        }
      }
    }
  }
  return least_m;
}

LinkSurface::LinkSurface(const MeshWorld& world, std::size_t link)
    : triangles_B_(triangles_in(world, link, Pose::Identity())) {}

double LinkSurface::distance_m(const Eigen::Vector3d& p_B) const {
  double least_m = kInfinity;
  for (const auto& triangle : triangles_B_) {
    const double reach_m =
        std::max((triangle[1] - triangle[0]).norm(), (triangle[2] - triangle[0]).norm());
    if ((triangle[0] - p_B).norm() - reach_m >= least_m) continue;
    least_m = std::min(least_m, mesh::closest_points(triangle, {&p_B, 1}).distance_m);
  }
  return least_m;
}

}  // namespace berth::testing
