#include "berth/calibration/closed_surface.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>

#include "sim/random.hpp"
#include "sim/winding_number.hpp"

namespace berth {
namespace {

using sim::Random;
using sim::winding_number;

SolidCells box_of(const Cell& first, const Cell& size) {
  SolidCells solid{first, size, {}};
  solid.is_solid.assign(static_cast<std::size_t>(size.prod()), 0);
  return solid;
}

/// Some boxes, each of which meets the one before.
SolidCells draw_body(Random& random) {
  SolidCells solid = box_of({-3, 40, 7}, {30, 25, 40});
  Cell at = solid.first + solid.size / 2;
  for (int i = 0; i < 4; ++i) {
    const Cell half(random.whole(0, 5), random.whole(0, 5), random.whole(0, 9));
    for (int z = -half.z(); z <= half.z(); ++z) {
      for (int y = -half.y(); y <= half.y(); ++y) {
        for (int x = -half.x(); x <= half.x(); ++x) {
          const Cell in = at + Cell(x, y, z) - solid.first;
          if ((in.array() < 0).any() || (in.array() >= solid.size.array()).any()) continue;
          solid.is_solid[solid.index_of(at + Cell(x, y, z))] = 1;
        }
      }
    }
    for (int axis = 0; axis < 3; ++axis) at[axis] += random.whole(-half[axis], half[axis]);
  }
  return solid;
}

double volume_m3(const TriangleMesh& mesh) {
  double volume = 0;
  for (const auto& [a, b, c] : mesh.triangles) {
    volume += mesh.vertices_m[a].cast<double>().dot(
                  mesh.vertices_m[b].cast<double>().cross(mesh.vertices_m[c].cast<double>())) /
              6;
  }
  return volume;
}

double volume_m3(const SolidCells& solid) {
  const auto cells = std::ranges::count(solid.is_solid, 1);
  return static_cast<double>(cells) * kCell_m * kCell_m * kCell_m;
}

TEST(DistanceField, IsThatOfALookAtAllCells) {
  Random random(3);
  SolidCells solid = box_of({2, -3, 1}, {6, 5, 7});
  for (std::uint8_t& is_solid : solid.is_solid) is_solid = random.chance(0.2);
  constexpr int kMargin = 2;
  const Cell size = solid.size + Cell::Constant(2 * kMargin);
  const std::vector<float> field = distance_field(solid, kMargin);
  ASSERT_EQ(field.size(), static_cast<std::size_t>(size.prod()));
  const auto each = [&](const auto& visit) {
    for (int z = 0; z < size.z(); ++z) {
      for (int y = 0; y < size.y(); ++y) {
        for (int x = 0; x < size.x(); ++x) visit(Cell(x, y, z));
      }
    }
  };
  const auto is_solid = [&](const Cell& at) {
    return solid.contains(solid.first + at - Cell::Constant(kMargin));
  };
  std::size_t i = 0;
  each([&](const Cell& at) {
    double nearest = 1e9;
    each([&](const Cell& other) {
      if (is_solid(other) != is_solid(at)) {
        nearest = std::min(nearest, (other - at).cast<double>().norm());
      }
    });
    EXPECT_NEAR(field[i++], is_solid(at) ? -nearest : nearest, 1e-4) << at.transpose();
  });
}

TEST(ClosedSurface, HoldsAllCellsAndIsNotMuchLarger) {
  Random random(1);
  for (int i = 0; i < 4; ++i) {
    SCOPED_TRACE(i);
    const SolidCells solid = draw_body(random);
    const TriangleMesh mesh = closed_surface(solid, 0.008);
    EXPECT_LE(mesh.triangles.size(), kMostSurfaceTriangles);
    const std::vector<float> field = distance_field(solid, 10);
    const Cell size = solid.size + Cell::Constant(20);
    int inside = 0;
    int checked = 0;
    std::size_t k = 0;
    for (int z = 0; z < size.z(); ++z) {
      for (int y = 0; y < size.y(); ++y) {
        for (int x = 0; x < size.x(); ++x, ++k) {
          if ((x + 3 * y + 5 * z) % 11 != 0) continue;
          const Eigen::Vector3d p_m = middle_of(solid.first + Cell(x, y, z) - Cell::Constant(10));
          const double turns = winding_number(mesh, p_m);
          EXPECT_NEAR(turns, std::round(turns), 1e-3);
          // The cells' own size, 8 mm and less than 12 mm for few triangles.
          if (field[k] <= 0) {
            EXPECT_NEAR(turns, 1, 1e-3) << p_m.transpose();
          }
          if (field[k] * kCell_m > 0.0025 + 0.008 + 0.012) {
            EXPECT_NEAR(turns, 0, 1e-3) << p_m.transpose();
          }
          ++checked;
          inside += turns > 0.5;
        }
      }
    }
    EXPECT_GT(inside, 0);
    EXPECT_LT(inside, checked);
  }
}

TEST(ClosedSurface, EachEdgeHasTwoTrianglesAndTheOutsideIsWhereItShouldBe) {
  Random random(2);
  for (int i = 0; i < 20; ++i) {
    SCOPED_TRACE(i);
    const SolidCells solid = draw_body(random);
    const TriangleMesh mesh = closed_surface(solid, 0.005);
    // Each edge is gone along as often in one direction as in the other.
    std::map<std::pair<std::uint32_t, std::uint32_t>, int> edges;
    for (const auto& t : mesh.triangles) {
      for (std::size_t k = 0; k < 3; ++k) {
        const std::uint32_t a = t[k];
        const std::uint32_t b = t[(k + 1) % 3];
        ASSERT_NE(a, b);
        edges[std::minmax(a, b)] += a < b ? 1 : -1;
      }
    }
    for (const auto& [edge, balance] : edges) EXPECT_EQ(balance, 0);
    EXPECT_GT(volume_m3(mesh), volume_m3(solid));
  }
}

TEST(ClosedSurface, ASingleCellHasTwoSidesToo) {
  SolidCells solid = box_of({0, 0, 0}, {1, 1, 1});
  solid.is_solid[0] = 1;
  const TriangleMesh mesh = closed_surface(solid, 0);
  EXPECT_GT(mesh.triangles.size(), 3U);
  EXPECT_GT(volume_m3(mesh), volume_m3(solid));
  EXPECT_NEAR(winding_number(mesh, middle_of({0, 0, 0})), 1, 1e-3);
}

}  // namespace
}  // namespace berth
