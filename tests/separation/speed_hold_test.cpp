#include "berth/separation/speed_hold.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <random>

namespace berth {
namespace {

TEST(SpeedHold, BeginsWithAStop) {
  SpeedHold hold(0.3);
  EXPECT_EQ(hold.next(1, 1, 10), 0);
  EXPECT_EQ(hold.next(1, 1, 10.29), 0);
  EXPECT_EQ(hold.next(1, 1, 10.31), 1);
}

TEST(SpeedHold, FallsAtOnceAndRisesLate) {
  SpeedHold hold(0.3);
  hold.next(1, 1, 0);
  ASSERT_EQ(hold.next(1, 1, 0.4), 1);
  EXPECT_EQ(hold.next(0.5, 0.4, 0.401), 0.5);
  EXPECT_EQ(hold.next(1, 1, 0.5), 0.5);
  EXPECT_EQ(hold.next(1, 1, 0.79), 0.5);
  EXPECT_EQ(hold.next(1, 1, 0.81), 1);
}

TEST(SpeedHold, DoesNotRiseWhereThereIsRoomButNoneToSpare) {
  SpeedHold hold(0.3);
  hold.next(1, 1, 0);
  hold.next(1, 1, 0.4);
  ASSERT_EQ(hold.next(0.5, 0.4, 0.41), 0.5);
  for (double t = 0.42; t < 3; t += 0.01) EXPECT_EQ(hold.next(0.55, 0.49, t), 0.5);
}

TEST(SpeedHold, AClockThatGoesBackOrIsLostBeginsTheWaitAnew) {
  for (const double bad_s : {0.0, std::numeric_limits<double>::quiet_NaN()}) {
    SpeedHold hold(0.3);
    EXPECT_EQ(hold.next(1, 1, 5), 0);
    EXPECT_EQ(hold.next(1, 1, bad_s), 0);
    EXPECT_EQ(hold.next(1, 1, 5.29), 0);
    EXPECT_EQ(hold.next(1, 1, 5.35), 0);
  }
}

TEST(SpeedHold, IsNeverAboveWhatIsAllowedNow) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> number(0, 1);
  SpeedHold hold(0.01);
  double t = 0;
  int rises = 0;
  double before = 0;
  for (int i = 0; i < 10000; ++i) {
    t += 0.002 * number(random);
    const double falling = 0.5 + 0.5 * number(random);
    const double scale = hold.next(falling, 0.9 * falling, t);
    EXPECT_LE(scale, falling);
    rises += scale > before;
    before = scale;
  }
  EXPECT_GT(rises, 3);
}

}  // namespace
}  // namespace berth
