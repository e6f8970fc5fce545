// No bound lies above the truth: of points, by a tree of patches, and of cubes, by their corners.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "sim/random.hpp"
#include "tests/distance/vector_bounds.hpp"
#include "tests/support/only_target.hpp"
#include "tests/support/thinned.hpp"

namespace berth::testing {
namespace {

constexpr float kError_m = 1e-5f;

/// Loose triangles: small ones, large ones, needles, and some without any area.
TriangleMesh draw_triangles(sim::Random& random, int count) {
  TriangleMesh mesh;
  for (int i = 0; i < count; ++i) {
    const Eigen::Vector3d at = sim::draw_point(random, 0.3);
    const double size_m = std::pow(10.0, random(-3, -0.7));
    const Eigen::Vector3d along = sim::draw_point(random, size_m);
    Eigen::Vector3d across = sim::draw_point(random, size_m);
    const int kind = random.whole(0, 5);
    if (kind == 0) across = 0.5 * along + sim::draw_point(random, 1e-5);
    if (kind == 1) across = along;
    if (kind == 2 && random.chance(0.2)) across = Eigen::Vector3d::Zero();
    const auto first = static_cast<std::uint32_t>(mesh.vertices_m.size());
    for (const Eigen::Vector3d& p :
         {at, Eigen::Vector3d(at + along), Eigen::Vector3d(at + across)}) {
      mesh.vertices_m.push_back(p.cast<float>());
    }
    mesh.triangles.push_back({first, first + 1, first + 2});
  }
  return mesh;
}

double distance_to_segment(const Eigen::Vector3d& p, const Eigen::Vector3d& a,
                           const Eigen::Vector3d& b) {
  const double length2 = (b - a).squaredNorm();
  const double t = length2 > 0 ? std::clamp((p - a).dot(b - a) / length2, 0.0, 1.0) : 0;
  return (p - a - t * (b - a)).norm();
}

/// Of the three edges, and of the inside where p lies over it.
double distance_to_triangle(const Eigen::Vector3d& p, const Eigen::Vector3d& a,
                            const Eigen::Vector3d& b, const Eigen::Vector3d& c) {
  const double to_edges = std::min(
      {distance_to_segment(p, a, b), distance_to_segment(p, b, c), distance_to_segment(p, c, a)});
  const Eigen::Vector3d normal = (b - a).cross(c - a);
  if (!(normal.norm() > 0)) return to_edges;
  const Eigen::Vector3d n = normal.normalized();
  const bool is_over = (b - a).cross(p - a).dot(n) >= 0 && (c - b).cross(p - b).dot(n) >= 0 &&
                       (a - c).cross(p - c).dot(n) >= 0;
  return is_over ? std::min(to_edges, std::abs(n.dot(p - a))) : to_edges;
}

/// One link's surface in both ways.
struct Surface {
  explicit Surface(TriangleMesh triangles) : mesh(std::move(triangles)) {
    RobotModel model;
    model.links.push_back({});
    model.links[0].mesh_L = mesh;
    model.evaluated_links = {0};
    patches = build_robot_patches(model);
  }
  const LinkPatches& link() const { return patches->links[0]; }
  double distance_m(const Eigen::Vector3d& p) const {
    double least_m = HUGE_VAL;
    for (const auto& [a, b, c] : mesh.triangles) {
      least_m = std::min(least_m, distance_to_triangle(p, mesh.vertices_m[a].cast<double>(),
                                                       mesh.vertices_m[b].cast<double>(),
                                                       mesh.vertices_m[c].cast<double>()));
    }
    return least_m;
  }

  TriangleMesh mesh;
  std::shared_ptr<const RobotPatches> patches;
};

TEST(MeshBounds, OfPointsHoldTheTruthOnEveryInstructionSet) {
  on_every_target([&](const char* target) {
    SCOPED_TRACE(target);
    sim::Random random(3);
    for (const int triangles : {1, 5, 16, 17, 300, 5000}) {
      const Surface surface(draw_triangles(random, triangles));
      const auto leaves = static_cast<int>(surface.link().levels[0].count);
      for (int i = 0; i < thinned(30000 / (triangles + 150)); ++i) {
        const int count = random.whole(1, 8);
        const double reach_m = random.chance(0.5) ? 0.002 : 0.1;
        const float slack_m = random.chance(0.5) ? 0.0f : 0.003f;
        Eigen::Vector3d middle = sim::draw_point(random, random.chance(0.2) ? 2 : 0.4);
        // On the surface, too.
        if (random.chance(0.2)) middle = surface.mesh.vertices_m[0].cast<double>();
        Eigen::Vector3f p_L_m[8];
        PointBounds found[8];
        for (int k = 0; k < count; ++k) {
          p_L_m[k] = (middle + sim::draw_point(random, reach_m)).cast<float>();
        }
        bound_points(surface.link(), kError_m, random.whole(0, leaves - 1), slack_m, count, p_L_m,
                     found);
        for (int k = 0; k < count; ++k) {
          const double true_m = surface.distance_m(p_L_m[k].cast<double>());
          ASSERT_LE(found[k].lower_m, true_m);
          ASSERT_GE(found[k].upper_m, true_m);
          ASSERT_LE(found[k].upper_m - found[k].lower_m, slack_m + 4 * kError_m);
          ASSERT_GE(found[k].triangle, 0);
          ASSERT_LT(found[k].triangle, triangles);
          if (slack_m > 0) continue;
          PointBounds alone;
          bound_points(surface.link(), kError_m, random.whole(0, leaves - 1), 0, 1, &p_L_m[k],
                       &alone);
          ASSERT_EQ(alone.lower_m, found[k].lower_m);
        }
      }
    }
  });
}

TEST(MeshBounds, OfFieldsLieBelowTheTruthAndMostlyByLittle) {
  on_every_target([&](const char* target) {
    SCOPED_TRACE(target);
    sim::Random random(6);
    for (const int triangles : {1, 17, 300}) {
      const Surface surface(draw_triangles(random, triangles));
      int told = 0, near = 0;
      for (int i = 0; i < thinned(600); ++i) {
        const Eigen::Vector3f p_L_m = sim::draw_point(random, random(0.2, 0.9)).cast<float>();
        const auto true_m = static_cast<float>(surface.distance_m(p_L_m.cast<double>()));
        // Asked for by what was thought before, which may be less.
        const float thought_m = true_m - static_cast<float>(random(0, 0.04));
        const float found_m = std::sqrt(bound_by_field_m2(surface.link(), 0, thought_m, p_L_m));
        ASSERT_LE(found_m, true_m + kError_m);
        if (thought_m < 0.04f || thought_m > 1.1f) continue;
        ++told;
        // Between two parts of the surface that are equally far, more is missing.
        near += found_m >= true_m - 0.0008f;
      }
      EXPECT_GT(told, thinned(600) / 3);
      EXPECT_GT(near, 0.9 * told);
    }
  });
}

TEST(MeshBounds, OfCubesLieBelowAllOfTheirPoints) {
  on_every_target([&](const char* target) {
    SCOPED_TRACE(target);
    sim::Random random(4);
    double least_missing_m = HUGE_VAL;
    for (int world = 0; world < thinned(12); ++world) {
      const Surface surface(draw_triangles(random, random.whole(1, 60)));
      for (int i = 0; i < 20; ++i) {
        const double edge_m = std::pow(10.0, random(-4, -0.4));
        const Eigen::Vector3d corner = sim::draw_point(random, 0.5);
        std::array<float, 8> squared_m2;
        const auto at = [&](const Eigen::Vector3d& t) {
          return surface.distance_m(corner + edge_m * t);
        };
        for (int k = 0; k < 8; ++k) {
          const auto d = static_cast<float>(at(Eigen::Vector3d(k & 1, k >> 1 & 1, k >> 2)));
          squared_m2[k] = d * d;
        }
        std::array<float, 64> children_m;
        const auto edge = static_cast<float>(edge_m);
        bound_cube_children(squared_m2, edge, children_m);
        const float whole_m = bound_cube(squared_m2, edge);
        ASSERT_LE(bound_cube_centre(squared_m2, edge), at({0.5, 0.5, 0.5}) + 1e-6);
        for (int k = 0; k < 200; ++k) {
          const Eigen::Vector3d t(random(0, 1), random(0, 1), random(0, 1));
          const Eigen::Vector3i cell = (4 * t).cast<int>();
          const double true_m = at(t);
          ASSERT_LE(whole_m, true_m + 1e-6);
          ASSERT_LE(children_m[cell.x() + 4 * cell.y() + 16 * cell.z()], true_m + 1e-6);
          least_missing_m = std::min(least_missing_m, true_m - whole_m);
        }
        const std::array<float, 3> begin = {0.25f, 0.5f, 0.75f};
        const auto within = bound_corners_within(squared_m2, edge, begin, 0.25f);
        for (int k = 0; k < 8; ++k) {
          const Eigen::Vector3d t(0.25 + (k & 1) * 0.25, 0.5 + (k >> 1 & 1) * 0.25,
                                  0.75 + (k >> 2) * 0.25);
          ASSERT_LE(std::sqrt(within[k]), at(t) + 1e-6);
        }
      }
    }
    // They are not all 0.
    EXPECT_LT(least_missing_m, 1e-3);
  });
}

/// Towards a wall nothing is lost. Along it, f lies below the truth by E^2 / 4 on each axis.
TEST(MeshBounds, OfCubesBeforeAWall) {
  for (const float before_m : {0.0f, 0.02f, 0.3f}) {
    std::array<float, 8> squared_m2;
    for (int k = 0; k < 8; ++k) {
      const float z = before_m + 0.1f * static_cast<float>(k >> 2);
      squared_m2[k] = z * z;
    }
    const float sag_m2 = 0.1f * 0.1f / 2;
    const float expected_m = std::sqrt(std::max(0.0f, before_m * before_m - sag_m2));
    EXPECT_NEAR(bound_cube(squared_m2, 0.1f), expected_m, 2e-4f);
  }
}

}  // namespace
}  // namespace berth::testing
