// The field's bounds against points of space, asked one by one by the definition.
#include "berth/space/clearance_field.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "berth/robot/primitives.hpp"
#include "sim/drawn_obstacles.hpp"
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
      if (world.is_there(p_B)) there_m.push_back(p_B);
    }
    for (int i = 0; i < 400; ++i) {
      const Eigen::Vector3d p_B = sim::draw_point(random, 0.4);
      const float lower_m = world.field().at(p_B).lower_m;
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
    for (std::size_t size = 0; size < 2; ++size) {
      const auto& count = grid.point_count[size];
      const double edge_m = ClearanceField::kCell_m * static_cast<double>(1 << size);
      for (int i = 0; i < count[0] * count[1] * count[2]; ++i) {
        const std::uint32_t point = grid.point[size][i];
        if (point == ClearanceField::kNoPoint) continue;
        const Eigen::Vector3d cell(i % count[0], i / count[0] % count[1], i / count[0] / count[1]);
        const Eigen::Vector3d steps(point & 1023, point >> 10 & 1023, point >> 20 & 1023);
        const Eigen::Vector3d p_B =
            grid.low_B_m.cast<double>() + edge_m * cell + 1e-4 * (steps.array() + 0.5).matrix();
        ASSERT_TRUE(world.is_there(p_B, 1e-6)) << p_B.transpose();
        // The field's upper bound is the way to such a point.
        if (size == 0 && i % 64 == 0) {
          EXPECT_LT(world.field().at(p_B).upper_m, 1e-6);
        }
        ++known;
      }
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
      const ClearanceField::Bounds bounds = field.at(p_B_m);
      ASSERT_LE(bounds.lower_m, true_m + 1e-5) << p_B_m.transpose();
      // Within it, the surface may be farther off than what counts.
      if (true_m > 0) {
        ASSERT_GE(bounds.upper_m, true_m - 2e-4);
      }
      // A box of 6.4 mm, and its diagonal.
      if (is_node && true_m < ClearanceField::kRange_m) {
        ASSERT_GE(bounds.lower_m, true_m - 0.0112) << p_B_m.transpose();
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
      ASSERT_LE(field.at(at_m * way).lower_m, beyond_m - at_m + kTriangles_m) << at_m;
    }
  }
}

TEST(ClearanceField, BesideItNothingIsKnown) {
  const FieldWorld world(1);
  const ClearanceField::Bounds bounds = world.field().at({3, 0, 0});
  EXPECT_EQ(bounds.lower_m, 0);
  EXPECT_TRUE(std::isinf(bounds.upper_m));
}

}  // namespace
}  // namespace berth::testing
