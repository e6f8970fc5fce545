#include "berth/separation/link_speed.hpp"

#include <algorithm>

namespace berth {
namespace {

using Eigen::Vector3f;

const Vector3f& farthest_along(const std::vector<Vector3f>& points, const Vector3f& direction) {
  return *std::ranges::max_element(points, {},
                                   [&](const Vector3f& point) { return point.dot(direction); });
}

/// From the hull of some points towards a vertex that it does not cover; zero where it does.
/// Gilbert's algorithm: x walks in the hull towards the vertex. What it has not decided by the end
/// is taken for uncovered.
Vector3f way_out(const std::vector<Vector3f>& hull, const Vector3f& vertex, float slack_m) {
  constexpr int kSteps = 50;
  Vector3f x = *std::ranges::min_element(
      hull, {}, [&](const Vector3f& point) { return (point - vertex).squaredNorm(); });
  for (int step = 0; step < kSteps; ++step) {
    const Vector3f way = vertex - x;
    if (way.squaredNorm() <= slack_m * slack_m) return Vector3f::Zero();
    const Vector3f to_corner = farthest_along(hull, way) - x;
    const float gain = way.dot(to_corner);
    // The whole hull lies so far behind the vertex that it cannot come within the slack.
    if (way.squaredNorm() - gain > slack_m * way.norm()) return way;
    if (gain <= 0) return way;
    x += std::min(1.0F, gain / to_corner.squaredNorm()) * to_corner;
  }
  return vertex - x;
}

std::vector<Vector3f> corners_along_axes(const std::vector<Vector3f>& vertices) {
  std::vector<Vector3f> corners;
  for (int axis = 0; axis < 3; ++axis) {
    corners.push_back(farthest_along(vertices, Vector3f::Unit(axis)));
    corners.push_back(farthest_along(vertices, -Vector3f::Unit(axis)));
  }
  return corners;
}

/// The twist in the link's own frame.
LinkTwist in_link(const Pose& X_BL, const LinkTwist& twist) {
  return {X_BL.linear().transpose() * twist.linear_B_m_s,
          X_BL.linear().transpose() * twist.angular_B_rad_s};
}

}  // namespace

HullPoints hull_points(const TriangleMesh& mesh_L, float slack_m) {
  if (mesh_L.vertices_m.empty()) return {{}, slack_m};
  HullPoints hull{corners_along_axes(mesh_L.vertices_m), slack_m};
  for (const Vector3f& vertex : mesh_L.vertices_m) {
    for (Vector3f way = way_out(hull.points_L_m, vertex, slack_m); !way.isZero();
         way = way_out(hull.points_L_m, vertex, slack_m)) {
      const Vector3f& corner = farthest_along(mesh_L.vertices_m, way);
      const bool is_new = std::ranges::find(hull.points_L_m, corner) == hull.points_L_m.end();
      hull.points_L_m.push_back(is_new ? corner : vertex);
    }
  }
  return hull;
}

double greatest_speed_m_s(const HullPoints& hull, const Pose& X_BL, const LinkTwist& twist) {
  const LinkTwist twist_L = in_link(X_BL, twist);
  const Vector3f v = twist_L.linear_B_m_s.cast<float>();
  const Vector3f w = twist_L.angular_B_rad_s.cast<float>();
  float greatest = 0;
  for (const Vector3f& p : hull.points_L_m) {
    greatest = std::max(greatest, (v + w.cross(p)).squaredNorm());
  }
  return std::sqrt(greatest) + w.norm() * hull.slack_m;
}

double greatest_displacement_m(const HullPoints& hull, const Pose& X_BL_before, const Pose& X_BL) {
  const Eigen::Matrix3f turn = (X_BL.linear() - X_BL_before.linear()).cast<float>();
  const Vector3f step = (X_BL.translation() - X_BL_before.translation()).cast<float>();
  float greatest = 0;
  for (const Vector3f& p : hull.points_L_m) {
    greatest = std::max(greatest, (turn * p + step).squaredNorm());
  }
  constexpr float kRounding_m = 2e-6F;
  return std::sqrt(greatest) + turn.norm() * hull.slack_m + kRounding_m;
}

}  // namespace berth
