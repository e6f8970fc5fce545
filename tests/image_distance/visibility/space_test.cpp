// Shares of the space around an answer that can be told without a program.
#include <gtest/gtest.h>

#include "berth/robot/primitives.hpp"
#include "tests/image_distance/visibility/small_world.hpp"

namespace berth {
namespace {

constexpr float kError = 0.05F;

/// A plate of 0.4 m, 2 m before the camera: the columns and rows from 130 to 190, 90 to 150.
class Space : public ::testing::Test {
 protected:
  SmallWorld world_{{make_box({0.4, 0.4, 0.02})}, {at(0, 0, 2)}};
};

LinkDistance answer_of(LinkStatus status, float distance_m, float lower_bound_m) {
  LinkDistance link;
  link.status = status;
  link.distance_m = distance_m;
  link.lower_bound_m = lower_bound_m;
  return link;
}

TEST_F(Space, WhereAReadingLiesBehindItIsSeen) {
  const LinkVisibility link = world_.around({0.6F, 0, 2}, 0.2F);
  EXPECT_EQ(link.space.seen, 1);
  EXPECT_EQ(link.space_unknown, 0);
}

TEST_F(Space, BehindAnObstacleItIsItsShadowAndNotUnknown) {
  world_.put({0, 0, 120, 240}, 1);
  const LinkVisibility link = world_.around({-0.8F, 0, 2}, 0.2F);
  EXPECT_EQ(link.space.hidden_by_obstacles, 1);
  EXPECT_EQ(link.space_unknown, 0);
}

TEST_F(Space, ObstacleInFrontOffTheAxisReachesIntoTheBallOfItsDistance) {
  // By Hirt 2.14 it is taken at the robot point's depth: (0.5 - 0.4) 2 m beside it.
  world_.put({309, 0, 320, 240}, 1.8F);
  const LinkVisibility link = world_.around({0.8F, 0, 2}, 0.2F);
  EXPECT_GT(link.space.hidden_by_obstacles, 0);
}

TEST_F(Space, BehindTheRobotItIsUnknown) {
  const LinkVisibility link = world_.around({0, 0, 2.3F}, 0.1F);
  EXPECT_EQ(link.space.hidden_by_robot, 1);
  EXPECT_EQ(link.space_unknown, 1);
}

TEST_F(Space, BeforeTheRobotItIsUnknownWhereAReadingWouldBeRemoved) {
  // The plate's face is at 1.99 m, the tolerance 0.05 m.
  EXPECT_EQ(world_.around({0, 0, 1.965F}, 0.02F).space.hidden_by_robot, 1);
  EXPECT_EQ(world_.around({0, 0, 1.915F}, 0.02F).space.seen, 1);
  world_.settings.tolerance_m = 0.1;
  EXPECT_EQ(world_.around({0, 0, 1.915F}, 0.02F).space.hidden_by_robot, 1);
}

TEST_F(Space, WithoutReadingItIsUnknown) {
  world_.put({200, 0, 320, 240}, kNoDepth);
  const LinkVisibility link = world_.around({0.6F, 0, 2}, 0.1F);
  EXPECT_EQ(link.space.no_reading, 1);
  EXPECT_EQ(link.space_unknown, 1);
}

TEST_F(Space, WhereReadingsWereDroppedBesideTheRobotItIsUnknown) {
  // 22 px beside the plate, which ends in column 189.
  world_.settings.padding_m = 0.15;
  world_.put(kEverywhere, 2);
  const LinkVisibility link = world_.around({0.28F, 0, 2}, 0.04F);
  EXPECT_EQ(link.space.no_reading, 1);
}

TEST_F(Space, BesideTheImageAndBehindTheCameraItIsUnknown) {
  // The edge is at x = 160 / 300 z.
  const LinkVisibility across = world_.around({160.0F / 150, 0, 2}, 0.1F);
  EXPECT_NEAR(across.space.outside_image, 0.5, kError);
  EXPECT_NEAR(across.space_unknown, 0.5, kError);
  EXPECT_EQ(world_.around({0, 0, -1}, 0.5F).space.outside_image, 1);
}

TEST_F(Space, OfABallAcrossTheRobotsFaceTheNearerHalfIsSeen) {
  world_.settings.tolerance_m = 0;
  const LinkVisibility link = world_.around({0, 0, 1.99F}, 0.1F);
  EXPECT_NEAR(link.space.seen, 0.5, kError);
  EXPECT_NEAR(link.space.hidden_by_robot, 0.5, kError);
}

TEST_F(Space, WithNothingInRangeItIsTheRangeAroundWhatTheImageShowsOfTheLink) {
  world_.settings.tolerance_m = 0;
  world_.put(kEverywhere, kNoDepth);
  world_.put({120, 80, 200, 160}, kWall_m);
  world_.put({130, 90, 190, 150}, 1.99F);
  const LinkDistance none = answer_of(LinkStatus::none_in_range, kNoDepth, 0);
  const SightShares near = world_.find(none, 0.02).front().space;
  EXPECT_NEAR(near.seen, 0.5, kError);
  const SightShares far = world_.find(none, 1).front().space;
  EXPECT_GT(far.no_reading, 0.3);
  EXPECT_LT(far.seen, 0.3);
}

TEST_F(Space, OfASearchThatWasCutItIsWithinTheLowerBound) {
  world_.settings.tolerance_m = 0;
  const auto space = [&](float lower_bound_m) {
    return world_.find(answer_of(LinkStatus::cut_short, kNoDepth, lower_bound_m)).front().space;
  };
  EXPECT_NEAR(space(0.01F).seen, 0.5, kError);
  EXPECT_FALSE(space(0).is_known());
}

TEST_F(Space, WithoutABallThereAreNoShares) {
  EXPECT_FALSE(world_.around({0, 0, 1.99F}, 0).space.is_known());
  EXPECT_TRUE(std::isnan(world_.around({0, 0, 1.99F}, 0).space_unknown));
  EXPECT_FALSE(
      world_.find(answer_of(LinkStatus::not_visible, kNoDepth, kNoDepth)).front().space.is_known());
  SmallWorld unseen({make_sphere(0.1)}, {at(0, 0, -1)});
  EXPECT_FALSE(
      unseen.find(answer_of(LinkStatus::none_in_range, kNoDepth, 1)).front().space.is_known());
}

}  // namespace
}  // namespace berth
