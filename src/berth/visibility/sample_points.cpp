#include "berth/visibility/sample_points.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace berth {
namespace {

/// The k-th point of a sequence that fills the unit cube evenly (M. Roberts, "The unreasonable
/// effectiveness of quasirandom sequences", 2018: powers of the root of x^4 = x + 1).
Eigen::Vector3d even_point(int k) {
  const Eigen::Array3d step(0.8191725133961645, 0.6710436067037893, 0.5497004779019703);
  const Eigen::Array3d at = 0.5 + k * step;
  return at - at.floor();
}

struct Triangle {
  Eigen::Vector3d corner_L_m;
  Eigen::Vector3d edges_L_m[2];

  /// Twice the triangle's area long.
  Eigen::Vector3d cross() const { return edges_L_m[0].cross(edges_L_m[1]); }
};

Triangle triangle_of(const TriangleMesh& mesh_L, std::size_t i) {
  const auto corner = [&](int k) -> Eigen::Vector3d {
    return mesh_L.vertices_m[mesh_L.triangles[i][k]].cast<double>();
  };
  return {corner(0), {corner(1) - corner(0), corner(2) - corner(0)}};
}

/// s and t are in [0, 1).
SurfacePoint point_on(const Triangle& triangle, double s, double t) {
  const bool beyond = s + t > 1;
  const double a = beyond ? 1 - s : s;
  const double b = beyond ? 1 - t : t;
  return {triangle.corner_L_m + a * triangle.edges_L_m[0] + b * triangle.edges_L_m[1],
          triangle.cross().normalized()};
}

template <class PointOf>
PointLanes lanes_of(std::size_t count, const PointOf& point_m) {
  PointLanes lanes;
  lanes.count = static_cast<int>(count);
  if (count == 0) return lanes;
  constexpr std::size_t kWhole = PointLanes::kMostLanes;
  const std::size_t wanted = std::max<std::size_t>(count, kSamplePoints);
  for (std::size_t i = 0; i < (wanted + kWhole - 1) / kWhole * kWhole; ++i) {
    const Eigen::Vector3f p_m = point_m(i % count).template cast<float>();
    for (int k = 0; k < 3; ++k) lanes.at_m[k].push_back(p_m[k]);
  }
  return lanes;
}

}  // namespace

std::vector<SurfacePoint> sample_surface(const TriangleMesh& mesh_L, int count) {
  double whole_area_m2 = 0;
  for (std::size_t i = 0; i < mesh_L.triangles.size(); ++i)
    whole_area_m2 += triangle_of(mesh_L, i).cross().norm() / 2;
  std::vector<SurfacePoint> points;
  if (!(whole_area_m2 > 0)) return points;

  double area_up_to_here_m2 = 0;
  for (std::size_t i = 0; i < mesh_L.triangles.size(); ++i) {
    const Triangle triangle = triangle_of(mesh_L, i);
    area_up_to_here_m2 += triangle.cross().norm() / 2;
    while (static_cast<int>(points.size()) < count) {
      const int k = static_cast<int>(points.size());
      const Eigen::Vector3d even = even_point(k);
      if ((k + even.x()) / count * whole_area_m2 >= area_up_to_here_m2) break;
      points.push_back(point_on(triangle, even.y(), even.z()));
    }
  }
  return points;
}

std::vector<Eigen::Vector3d> sample_unit_ball(int count) {
  std::vector<Eigen::Vector3d> points;
  for (int k = 0; k < count; ++k) {
    const Eigen::Vector3d even = even_point(k);
    const double radius = std::cbrt(even.x());
    const double angle_rad = 2 * std::numbers::pi * even.y();
    const double z = 1 - 2 * even.z();
    const double across = std::sqrt(1 - z * z);
    points.push_back(
        radius * Eigen::Vector3d(across * std::cos(angle_rad), across * std::sin(angle_rad), z));
  }
  return points;
}

SamplePoints sample_points(const RobotModel& model) {
  SamplePoints points;
  for (const std::size_t link : model.evaluated_links) {
    const auto& surface =
        points.surface.emplace_back(sample_surface(model.links[link].mesh_L, kSamplePoints));
    points.surface_lanes.push_back(lanes_of(
        surface.size(), [&](std::size_t i) -> const Eigen::Vector3d& { return surface[i].p_L_m; }));
  }
  points.unit_ball = sample_unit_ball(kSamplePoints);
  points.unit_ball_lanes =
      lanes_of(points.unit_ball.size(),
               [&](std::size_t i) -> const Eigen::Vector3d& { return points.unit_ball[i]; });
  return points;
}

}  // namespace berth
