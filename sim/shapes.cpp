#include "sim/shapes.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace berth::sim {
namespace {

using std::numbers::pi;

Ring make_circle(double radius_m, double z_m, int segments, double flatten) {
  Ring ring(segments);
  for (int i = 0; i < segments; ++i) {
    const double angle = 2 * pi * i / segments;
    ring[i] = {radius_m * std::cos(angle), flatten * radius_m * std::sin(angle), z_m};
  }
  return ring;
}

double catmull_rom(double p0, double p1, double p2, double p3, double t) {
  return p1 +
         0.5 * t * (p2 - p0 + t * (2 * p0 - 5 * p1 + 4 * p2 - p3 + t * (3 * (p1 - p2) + p3 - p0)));
}

// The half circle of a capsule's end, from angle `begin` to `end` above the equator.
void add_dome(Profile& profile, double radius_m, double z_m, double begin, double end) {
  constexpr int kSteps = 8;
  for (int i = 0; i <= kSteps; ++i) {
    const double angle = begin + (end - begin) * i / kSteps;
    const bool pole = std::abs(std::abs(angle) - pi / 2) < 1e-9;
    profile.push_back({pole ? 0 : radius_m * std::cos(angle), z_m + radius_m * std::sin(angle)});
  }
}

}  // namespace

void append(TriangleMesh& whole, const TriangleMesh& part, const Pose& X_AB) {
  whole.append(part, X_AB);
}

TriangleMesh make_skin(const std::vector<Ring>& rings) {
  TriangleMesh mesh;
  for (const Ring& ring : rings)
    for (const Eigen::Vector3d& p : ring) mesh.vertices_m.push_back(p.cast<float>());
  const auto add = [&mesh](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
    const auto& p = mesh.vertices_m;
    if (p[a] != p[b] && p[b] != p[c] && p[c] != p[a]) mesh.triangles.push_back({a, b, c});
  };
  const auto n = static_cast<std::uint32_t>(rings.front().size());
  for (std::uint32_t r = 0; r + 1 < rings.size(); ++r) {
    for (std::uint32_t i = 0; i < n; ++i) {
      const std::uint32_t j = (i + 1) % n;
      add(r * n + i, r * n + j, (r + 1) * n + j);
      add(r * n + i, (r + 1) * n + j, (r + 1) * n + i);
    }
  }
  return mesh;
}

TriangleMesh make_lathe(const Profile& profile, int segments, double flatten) {
  std::vector<Ring> rings;
  for (const ProfilePoint& p : profile)
    rings.push_back(make_circle(p.radius_m, p.z_m, segments, flatten));
  return make_skin(rings);
}

Profile smooth_profile(const Profile& points, int steps) {
  const auto at = [&points](std::ptrdiff_t i) {
    return points[std::clamp<std::ptrdiff_t>(i, 0, std::ssize(points) - 1)];
  };
  Profile smooth;
  for (std::ptrdiff_t i = 0; i + 1 < std::ssize(points); ++i) {
    const ProfilePoint p0 = at(i - 1), p1 = at(i), p2 = at(i + 1), p3 = at(i + 2);
    for (int k = 0; k < steps; ++k) {
      const double t = static_cast<double>(k) / steps;
      smooth.push_back({catmull_rom(p0.radius_m, p1.radius_m, p2.radius_m, p3.radius_m, t),
                        catmull_rom(p0.z_m, p1.z_m, p2.z_m, p3.z_m, t)});
    }
  }
  smooth.push_back(points.back());
  return smooth;
}

TriangleMesh make_capsule(double length_m, double r0_m, double r1_m, int segments) {
  Profile profile;
  add_dome(profile, r0_m, 0, -pi / 2, 0);
  add_dome(profile, r1_m, length_m, 0, pi / 2);
  return make_lathe(profile, segments);
}

TriangleMesh make_ellipsoid(const Eigen::Vector3d& half_axes_m, int segments) {
  Profile profile;
  add_dome(profile, 1, 0, -pi / 2, 0);
  profile.pop_back();
  add_dome(profile, 1, 0, 0, pi / 2);
  TriangleMesh mesh = make_lathe(profile, segments);
  for (Eigen::Vector3f& p : mesh.vertices_m) p = p.cwiseProduct(half_axes_m.cast<float>()).eval();
  return mesh;
}

TriangleMesh make_cuboid(const Eigen::Vector3d& size_m) {
  TriangleMesh mesh;
  for (int i = 0; i < 8; ++i) {
    const Eigen::Vector3d sign(i & 1 ? 1 : -1, i & 2 ? 1 : -1, i & 4 ? 1 : -1);
    mesh.vertices_m.push_back((0.5 * sign.cwiseProduct(size_m)).cast<float>());
  }
  mesh.triangles = {{0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}, {0, 1, 5}, {0, 5, 4},
                    {2, 6, 7}, {2, 7, 3}, {0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}};
  return mesh;
}

Pose translation(double x_m, double y_m, double z_m) {
  return Pose(Eigen::Translation3d(x_m, y_m, z_m));
}

Pose rotation(double angle_rad, const Eigen::Vector3d& axis) {
  return Pose(Eigen::AngleAxisd(angle_rad, axis));
}

}  // namespace berth::sim
