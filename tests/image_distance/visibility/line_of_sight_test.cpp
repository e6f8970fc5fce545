// Which pixel tells of a point.
#include <gtest/gtest.h>

#include "berth/robot/primitives.hpp"
#include "tests/image_distance/visibility/small_world.hpp"

namespace berth {
namespace {

/// A plate 2 m before the camera, and one 1 m before it that covers the columns from 200 on.
class LineOfSight : public ::testing::Test {
 protected:
  LineOfSight()
      : world_({make_box({2, 1, 0.02}), make_box({1, 1, 0.02})},
               {at(0, 0, 2), at(0.5 + 40.0 / 300, 0, 1)}) {
    world_.find();
  }

  /// On the pixel's line of sight, in the middle row.
  static Eigen::Vector3d point(double u, double depth_m) {
    return {(u - kPlainCamera.cx_px) / kPlainCamera.fx_px * depth_m, 0, depth_m};
  }
  Sight surface(double u) const {
    const LinkPoint on_face{1, point(u, 1.99), Eigen::Vector3d::UnitZ()};
    return sight_of_surface(world_.frame(), world_.robot, on_face).sight;
  }

  SmallWorld world_;
};

TEST_F(LineOfSight, PointInSpaceBelongsToTheNearestPixel) {
  EXPECT_EQ(sight_of_space(world_.frame(), point(199.4, 1.5)), Sight::seen);
  EXPECT_EQ(sight_of_space(world_.frame(), point(199.6, 1.5)), Sight::hidden_by_robot);
}

TEST_F(LineOfSight, NearestPixelDecidesWhetherAnotherLinkHidesAPoint) {
  EXPECT_EQ(surface(199.4), Sight::seen);
  EXPECT_EQ(surface(199.6), Sight::hidden_by_robot);
}

TEST_F(LineOfSight, ImageEndsWithItsLastPixel) {
  const double last = kPlainCamera.width_px - 1;
  EXPECT_EQ(sight_of_space(world_.frame(), point(last + 0.4, 0.5)), Sight::seen);
  EXPECT_EQ(sight_of_space(world_.frame(), point(last + 0.6, 0.5)), Sight::outside_image);
  EXPECT_EQ(sight_of_space(world_.frame(), point(-0.4, 0.5)), Sight::seen);
  EXPECT_EQ(sight_of_space(world_.frame(), point(-0.6, 0.5)), Sight::outside_image);
}

TEST_F(LineOfSight, FarSideOfALinkIsHiddenByItsNearSide) {
  const LinkPoint on_back{1, point(150.3, 2.01), Eigen::Vector3d::UnitZ()};
  EXPECT_EQ(sight_of_surface(world_.frame(), world_.robot, on_back).sight, Sight::hidden_by_robot);
}

TEST_F(LineOfSight, NormalMayPointToEitherSide) {
  const LinkPoint on_face{1, point(150.3, 1.99), -Eigen::Vector3d::UnitZ()};
  EXPECT_EQ(sight_of_surface(world_.frame(), world_.robot, on_face).sight, Sight::seen);
}

}  // namespace
}  // namespace berth
