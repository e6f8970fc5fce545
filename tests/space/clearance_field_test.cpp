// The field's bounds against points of space, asked one by one by the definition.
#include "berth/space/clearance_field.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "berth/robot/primitives.hpp"
#include "sim/drawn_obstacles.hpp"
#include "tests/support/field_bounds.hpp"
#include "tests/support/plain_distance.hpp"
#include "tests/support/thinned.hpp"

namespace berth::testing {
namespace {

constexpr double kReach_m = 0.7;

/// A drawn world, its field, and points that are occupied or unknown.
class FieldWorld {
 public:
  explicit FieldWorld(std::uint32_t seed)
      : world_(draw_mesh_world(settings(seed), 900 + seed)), prepared_(world_), plain_(world_) {
    field_.build(prepared_.space(), UnknownSpace(), Eigen::Vector3d::Zero(), kReach_m);
  }
  const ClearanceField& field() const { return field_; }
  bool is_there(const Eigen::Vector3d& p_B, double slack_m = 0) const {
    if (plain_.is_hidden(p_B)) return true;
    for (std::size_t k = 0; k < world_.views.size(); ++k) {
      if (plain_.is_reading(k, p_B, slack_m)) return true;
    }
    return false;
  }

 private:
  static MeshWorldSettings settings(std::uint32_t seed) {
    MeshWorldSettings settings;
    settings.views = 1 + static_cast<int>(seed % 4);
    settings.hides_otherwise = seed % 2 == 1;
    if (seed % 3 == 0) {
      // What is occupied is thicker than cells, and than a few pixels are wide.
      settings.width_px = 320, settings.height_px = 240;
      settings.space.surface_thickness_m = 0.1;
    }
    return settings;
  }

  MeshWorld world_;
  PreparedWorld prepared_;
  PlainSpace plain_;
  ClearanceField field_;
};

TEST(ClearanceField, NothingIsNearerThanItsLowerBound) {
  sim::Random random(3);
  int judged = 0;
  double gap_m = 0;
  for (std::uint32_t seed = 0; seed < thinned(12u); ++seed) {
    SCOPED_TRACE(seed);
    const FieldWorld world(seed);
    std::vector<Eigen::Vector3d> there_m;
    for (int i = 0; i < 60'000; ++i) {
      const Eigen::Vector3d p_B = sim::draw_point(random, 0.8);
      if (!world.is_there(p_B)) continue;
      there_m.push_back(p_B);
      // No node around it may take it for farther away.
      const ClearanceField::Grid grid = world.field().grid();
      for (int k = 0; k < 8; ++k) {
        const Eigen::Array3i node = cell_of(grid, p_B) + Eigen::Array3i(k & 1, k >> 1 & 1, k >> 2);
        if (!has(grid, node)) continue;
        const Eigen::Vector3d node_B_m =
            grid.low_B_m.cast<double>() + ClearanceField::kCell_m * node.cast<double>().matrix();
        const double told_m =
            ClearanceField::kBox_m * std::sqrt(grid.squared[place_of(grid, node)]);
        ASSERT_LE(told_m, (node_B_m - p_B).norm() + 1e-6) << p_B.transpose();
      }
    }
    for (int i = 0; i < 400; ++i) {
      const Eigen::Vector3d p_B = sim::draw_point(random, 0.4);
      const double lower_m = lower_bound_m(world.field().grid(), p_B);
      double least_m = std::numeric_limits<double>::infinity();
      for (const Eigen::Vector3d& q_B : there_m) least_m = std::min(least_m, (q_B - p_B).norm());
      ASSERT_LE(lower_m, least_m + 1e-6) << p_B.transpose();
      // In the ball itself, where the points above may be too sparse.
      for (int k = 0; k < 50 && lower_m > 0; ++k) {
        Eigen::Vector3d way = sim::draw_point(random, 1);
        if (way.norm() > 1) way.normalize();
        ASSERT_FALSE(world.is_there(p_B + (lower_m - 1e-6) * way)) << p_B.transpose();
      }
      if (least_m > 0.15) continue;
      ++judged;
      gap_m += least_m - lower_m;
    }
  }
  ASSERT_GT(judged, 0);
  // The points tell the distance to about two centimetres themselves.
  EXPECT_LT(gap_m / judged, 0.04);
}

TEST(ClearanceField, ItsPointsAreOccupiedOrUnknown) {
  for (std::uint32_t seed = 0; seed < thinned(12u); ++seed) {
    SCOPED_TRACE(seed);
    const FieldWorld world(seed);
    const ClearanceField::Grid grid = world.field().grid();
    int known = 0;
    for (int i = 0; i < grid.count[0] * grid.count[1] * grid.count[2]; ++i) {
      if (grid.point[i] == ClearanceField::kNoPoint) continue;
      const Eigen::Array3i cell(i % grid.count[0], i / grid.count[0] % grid.count[1],
                                i / grid.count[0] / grid.count[1]);
      const Eigen::Vector3d p_B = point_of(grid, cell);
      ASSERT_TRUE(world.is_there(p_B, 1e-6)) << p_B.transpose();
      ++known;
    }
    EXPECT_GT(known, 100);
  }
}

/// At nodes and elsewhere, on all sides of boxes whose distance is known by hand.
TEST(ClearanceField, OfBoxesIsWithinWhatItRounds) {
  sim::Random random(4);
  for (int n = 0; n < 20; ++n) {
    const Eigen::Vector3d size_m(random(0.03, 0.3), random(0.03, 0.3), random(0.03, 0.3));
    const Eigen::Vector3d middle_B_m = sim::draw_point(random, 0.2);
    std::vector<TriangleMesh> meshes(1);
    meshes[0].append(make_box(size_m), Eigen::Affine3d(Eigen::Translation3d(middle_B_m)));
    ClearanceField field;
    field.build(meshes, Eigen::Vector3d::Zero(), 0.5);
    const Eigen::Vector3d low_B_m = field.grid().low_B_m.cast<double>();
    for (int i = 0; i < 2000; ++i) {
      Eigen::Vector3d p_B_m = sim::draw_point(random, 0.28);
      const bool is_node = i % 2 == 0;
      if (is_node) {
        const Eigen::Array3d node = ((p_B_m - low_B_m) / ClearanceField::kCell_m).array().round();
        p_B_m = low_B_m + ClearanceField::kCell_m * node.matrix();
      }
      const Eigen::Array3d beside_m = ((p_B_m - middle_B_m).array().abs() - size_m.array() / 2);
      const double true_m = beside_m.max(0.0).matrix().norm();
      const double lower_m = lower_bound_m(field.grid(), p_B_m);
      ASSERT_LE(lower_m, true_m + 1e-5) << p_B_m.transpose();
      // Within it, the surface may be farther off than what counts.
      if (true_m > 0 && i < 200) {
        ASSERT_GE(upper_bound_m(field.grid(), p_B_m), true_m - 2e-4);
      }
      // A box of 6.4 mm, and its diagonal.
      if (is_node && true_m < ClearanceField::kRange_m) {
        ASSERT_GE(lower_m, true_m - 0.0112) << p_B_m.transpose();
      }
    }
  }
}

/// Places that nobody asks about may lie between nodes that are asked: what they say holds, too.
TEST(ClearanceField, AtItsRimNothingIsNearerThanItsLowerBound) {
  sim::Random random(5);
  constexpr double kRim_m = 0.5;
  for (int n = 0; n < 40; ++n) {
    const Eigen::Vector3d way = sim::draw_rotation(random) * Eigen::Vector3d::UnitX();
    const double beyond_m = random(kRim_m + 0.15, kRim_m + 0.3);
    std::vector<TriangleMesh> meshes(1);
    meshes[0].append(make_sphere(0.05),
                     Eigen::Affine3d(Eigen::Translation3d((beyond_m + 0.05) * way)));
    ClearanceField field;
    field.build(meshes, Eigen::Vector3d::Zero(), kRim_m);
    for (double at_m = kRim_m - 0.05; at_m < beyond_m; at_m += 0.002) {
      // The sphere's triangles lie within it.
      constexpr double kTriangles_m = 0.002;
      ASSERT_LE(lower_bound_m(field.grid(), at_m * way), beyond_m - at_m + kTriangles_m) << at_m;
    }
  }
}

}  // namespace
}  // namespace berth::testing
