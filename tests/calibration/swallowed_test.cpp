// How small a thing may be, on images in which the filter's rules tell it.
#include "berth/calibration/swallowed.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/fit/hand_made_image.hpp"

namespace berth {
namespace {

constexpr Camera kCamera{640, 480, 500, 500, 319.5, 239.5};

class Swallowed : public ::testing::Test {
 protected:
  Swallowed() {
    image_.camera = kCamera;
    image_.robot = {DepthImage(640, 480, kNoDepth), Image<LinkId>(640, 480, kNoLink)};
  }
  std::vector<FilteredCamera> views() {
    depth_m_ = sensed(image_.robot);
    return {{&kCamera, depth_m_, &image_.robot, &self_filter_, &sensor_}};
  }

  HandMadeImage image_;
  DepthImage depth_m_;
  SelfFilterSettings self_filter_;
  SensorSettings sensor_;
};

TEST_F(Swallowed, ALargeSpeckleSwallowsARodThatASmallOneKeeps) {
  sensor_.speckle_px = 20;
  const SmallestObstacle kept = smallest_obstacle(views(), 1);
  EXPECT_EQ(kept.depth_m, 1);
  EXPECT_EQ(kept.rod_width_m, 0.003);
  EXPECT_EQ(kept.finger_width_m, 0.003);
  // The rod of 8 mm has 150 x 4 pixels, that of 1 cm 150 x 5, and a finger of 3 cm 35 x 15.
  sensor_.speckle_px = 700;
  const SmallestObstacle swallowed = smallest_obstacle(views(), 1);
  EXPECT_EQ(swallowed.rod_width_m, 0.010);
  EXPECT_TRUE(std::isnan(swallowed.finger_width_m));
  sensor_.speckle_px = 100000;
  EXPECT_TRUE(std::isnan(smallest_obstacle(views(), 1).rod_width_m));
}

TEST_F(Swallowed, FartherAwayTheyHaveToBeLarger) {
  sensor_.speckle_px = 200;
  const double near_m = smallest_obstacle(views(), 1).rod_width_m;
  const double far_m = smallest_obstacle(views(), 2).rod_width_m;
  EXPECT_GT(far_m, near_m);
}

TEST_F(Swallowed, WithoutRoomNothingIsSaid) {
  add_plate({20, 20, 620, 460}, 1, 1, image_);
  const SmallestObstacle none = smallest_obstacle(views(), 1);
  EXPECT_TRUE(std::isnan(none.rod_width_m));
  EXPECT_TRUE(std::isnan(none.finger_width_m));
  // What would stand behind the wall is not drawn.
  image_.robot.link_id = Image<LinkId>(640, 480, kNoLink);
  image_.robot.depth_m = DepthImage(640, 480, kNoDepth);
  EXPECT_TRUE(std::isnan(smallest_obstacle(views(), kWall_m).rod_width_m));
}

TEST_F(Swallowed, ARodIsKeptOnceItIsBesideThePadding) {
  add_plate({280, 60, 360, 420}, 1.2F, 1, image_);
  self_filter_.padding_m = 0.02;
  const double narrow_m = least_rod_gap_m(views());
  self_filter_.padding_m = 0.06;
  const double wide_m = least_rod_gap_m(views());
  EXPECT_GE(narrow_m, 0.02);
  EXPECT_LE(narrow_m, 0.04);
  EXPECT_GE(wide_m, 0.06);
  EXPECT_LE(wide_m, 0.08);
  self_filter_.padding_m = 0.3;
  EXPECT_TRUE(std::isnan(least_rod_gap_m(views())));
}

}  // namespace
}  // namespace berth
