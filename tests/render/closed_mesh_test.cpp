// No pixel falls between neighbouring triangles: it would show the wall behind, which is a distance
// too large.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "berth/render/robot_renderer.hpp"
#include "tests/render/small_robot.hpp"

namespace berth {
namespace {

const Camera kCamera{160, 120, 150, 145, 78.6, 61.3};

/// 0 to `end` in steps between a third of the greatest and the greatest.
std::vector<double> uneven_steps(int count, double end, std::mt19937& random) {
  std::vector<double> at{0};
  std::uniform_real_distribution<double> step(0.5, 1.5);
  for (int i = 0; i < count; ++i) at.push_back(at.back() + step(random));
  const double scale = end / at.back();
  for (double& x : at) x *= scale;
  return at;
}

/// A closed mesh with all of its corners on the unit sphere.
TriangleMesh uneven_sphere(int rings, int columns, std::mt19937& random) {
  const std::vector<double> polar = uneven_steps(rings, std::numbers::pi, random);
  const std::vector<double> around = uneven_steps(columns, 2 * std::numbers::pi, random);
  TriangleMesh mesh;
  for (int ring = 0; ring <= rings; ++ring) {
    for (int column = 0; column < columns; ++column) {
      // Exactly at the poles, where all columns meet.
      const double radius = ring == 0 || ring == rings ? 0 : std::sin(polar[ring]);
      mesh.vertices_m.push_back(Eigen::Vector3d(radius * std::cos(around[column]),
                                                radius * std::sin(around[column]),
                                                std::cos(polar[ring]))
                                    .cast<float>());
    }
  }
  const auto vertex = [&](int ring, int column) {
    return static_cast<std::uint32_t>(ring * columns + column % columns);
  };
  for (int ring = 0; ring < rings; ++ring) {
    for (int column = 0; column < columns; ++column) {
      const std::uint32_t a = vertex(ring, column), b = vertex(ring, column + 1);
      const std::uint32_t c = vertex(ring + 1, column), d = vertex(ring + 1, column + 1);
      mesh.triangles.push_back({a, b, d});
      mesh.triangles.push_back({a, c, d});
    }
  }
  // Windings carry no meaning.
  for (auto& triangle : mesh.triangles) std::shuffle(triangle.begin(), triangle.end(), random);
  return mesh;
}

/// No triangle with corners on the unit sphere reaches nearer to its centre.
double inner_radius(const TriangleMesh& mesh) {
  double least = 1;
  for (const auto& [a, b, c] : mesh.triangles) {
    const Eigen::Vector3d p = mesh.vertices_m[a].cast<double>();
    const Eigen::Vector3d n =
        (mesh.vertices_m[b].cast<double>() - p).cross(mesh.vertices_m[c].cast<double>() - p);
    if (n.norm() > 0) least = std::min(least, std::abs(n.dot(p)) / n.norm());
  }
  return least;
}

/// The depth at which the ray through a pixel enters a ball; NaN where it misses.
double enter_ball(double u, double v, const Eigen::Vector3d& centre_C, double radius_m) {
  const Eigen::Vector3d ray((u - kCamera.cx_px) / kCamera.fx_px,
                            (v - kCamera.cy_px) / kCamera.fy_px, 1);
  const double half_b = ray.dot(centre_C);
  const double a = ray.squaredNorm();
  return (half_b -
          std::sqrt(half_b * half_b - a * (centre_C.squaredNorm() - radius_m * radius_m))) /
         a;
}

/// The least depth of a ball within 0.01 px of a pixel's centre.
double nearest_of_ball(int u, int v, const Eigen::Vector3d& centre_C, double radius_m) {
  double least_m = enter_ball(u, v, centre_C, radius_m);
  for (const double du : {-0.01, 0.01}) {
    for (const double dv : {-0.01, 0.01})
      least_m = std::fmin(least_m, enter_ball(u + du, v + dv, centre_C, radius_m));
  }
  return least_m;
}

/// A mesh with corners on the unit sphere must hide the ball inside. Returns the ball's pixels.
int expect_no_hole(RobotRenderer& renderer, double inner_radius_m, const Pose& X_CL) {
  RobotImage image;
  renderer.render({{X_CL}}, Pose::Identity(), image);
  const double radius_m = inner_radius_m - 1e-5;
  int hidden = 0;
  for (int v = 0; v < kCamera.height_px; ++v) {
    for (int u = 0; u < kCamera.width_px; ++u) {
      const double behind_m = enter_ball(u, v, X_CL.translation(), radius_m);
      if (std::isnan(behind_m)) continue;
      ++hidden;
      EXPECT_LE(image.depth_m(u, v), behind_m) << u << " " << v;
      EXPECT_GE(image.depth_m(u, v), nearest_of_ball(u, v, X_CL.translation(), 1) - 1e-5);
    }
  }
  return hidden;
}

TEST(ClosedMesh, HasNoHoles) {
  std::mt19937 random(12);
  // From triangles of tens of pixels to a hundred triangles in each.
  for (const int rings : {8, 15, 40, 110, 350}) {
    SCOPED_TRACE(rings);
    const TriangleMesh mesh = uneven_sphere(rings, rings + rings / 3, random);
    const double radius_m = inner_radius(mesh);
    RobotRenderer renderer(build_link_meshes(robot_of({mesh})), kCamera);
    for (const double distance_m : {1.4, 3.0, 9.0}) {
      const Pose X_CL = random_pose(
          random, {Eigen::Vector3d(-0.3, -0.2, distance_m), Eigen::Vector3d(0.3, 0.2, distance_m)});
      EXPECT_GT(expect_no_hole(renderer, radius_m, X_CL), 300);
    }
    // So near that some triangles are drawn in single precision and their neighbours are not.
    const Pose X_CL =
        random_pose(random, {Eigen::Vector3d(0, 0, 1.03), Eigen::Vector3d(0, 0, 1.03)});
    EXPECT_EQ(expect_no_hole(renderer, radius_m, X_CL), 160 * 120);
  }
}

/// A rectangle 1 m before the camera, cut into a fan around one of its points. All corners project
/// to centres of pixels, and enough edges pass through other centres.
TriangleMesh fan(const Camera& camera, const PixelRect& rect, int u, int v) {
  TriangleMesh mesh;
  const auto add = [&](int at_u, int at_v) {
    mesh.vertices_m.push_back(Eigen::Vector3d((at_u - camera.cx_px) / camera.fx_px,
                                              (at_v - camera.cy_px) / camera.fy_px, 1)
                                  .cast<float>());
  };
  add(u, v);
  for (int i = rect.u_begin; i < rect.u_end; ++i) add(i, rect.v_begin);
  for (int i = rect.v_begin; i < rect.v_end; ++i) add(rect.u_end, i);
  for (int i = rect.u_end; i > rect.u_begin; --i) add(i, rect.v_end);
  for (int i = rect.v_end; i > rect.v_begin; --i) add(rect.u_begin, i);
  const auto rim = static_cast<std::uint32_t>(mesh.vertices_m.size() - 1);
  for (std::uint32_t i = 0; i < rim; ++i) mesh.triangles.push_back({0, i + 1, (i + 1) % rim + 1});
  return mesh;
}

TEST(FlatMesh, HasNoHolesAtPixelCentresOnItsEdges) {
  const Camera camera{1200, 900, 611.3, 598.7, 571.2, 433.9};
  std::mt19937 random(9);
  for (const int size : {3, 9, 40, 150, 600, 880}) {
    for (int trial = 0; trial < 5; ++trial) {
      const int left = static_cast<int>(random() % (1200 - size - 1));
      const int top = static_cast<int>(random() % (900 - size - 1));
      const PixelRect rect{left, top, left + size, top + size};
      const TriangleMesh mesh = fan(camera, rect, left + 1 + static_cast<int>(random() % size),
                                    top + 1 + static_cast<int>(random() % size));
      RobotImage image;
      RobotRenderer(build_link_meshes(robot_of({mesh})), camera)
          .render({{Pose::Identity()}}, Pose::Identity(), image);
      for (int v = rect.v_begin + 1; v < rect.v_end; ++v) {
        for (int u = rect.u_begin + 1; u < rect.u_end; ++u)
          ASSERT_EQ(image.link_id(u, v), 1) << size << ": " << u << " " << v;
      }
    }
  }
}

}  // namespace
}  // namespace berth
