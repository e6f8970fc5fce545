#include "berth/watch/seen_through.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <deque>
#include <numeric>

#include "berth/watch/pose_watch.hpp"
#include "sim/random.hpp"

namespace berth {
namespace {

/// A robot 2 m before the camera that fills the image.
struct Images {
  explicit Images(int width = 20, int height = 10)
      : depth_m(width, height, 2.0F),
        robot{DepthImage(width, height, 2.0F), Image<LinkId>(width, height, 1)} {}

  RobotReadings read() const { return read_robot(depth_m, robot); }

  DepthImage depth_m;
  RobotImage robot;
};

TEST(SeenThrough, EachReadingCountsByWhereItLiesFromTheModel) {
  Images images;
  const float readings_m[] = {2.049F, 1.951F, 2.051F, 5.0F, 1.949F, 1.801F, 1.799F, 0.5F, kNoDepth};
  std::copy(std::begin(readings_m), std::end(readings_m), images.depth_m.row(4));
  const RobotReadings found = images.read();
  EXPECT_EQ(found.at_surface, 200 - 9 + 2);
  EXPECT_EQ(found.behind, 2);
  EXPECT_EQ(found.before, 2);
  EXPECT_EQ(found.hidden, 2);
  EXPECT_EQ(found.none, 1);
  EXPECT_DOUBLE_EQ(found.seen_through(), 2.0 / 195);
  EXPECT_DOUBLE_EQ(found.hidden_share(), 2.0 / 199);
}

TEST(SeenThrough, EnvironmentAndWhatIsNoRobotAreLeftOut) {
  Images images;
  for (int u = 0; u < 20; ++u) {
    images.robot.link_id(u, 0) = kEnvironmentLink;
    images.depth_m(u, 0) = 3;
    images.robot.link_id(u, 1) = kNoLink;
    images.robot.depth_m(u, 1) = kNoDepth;
  }
  const RobotReadings found = images.read();
  EXPECT_EQ(found.at_surface, 160);
  EXPECT_EQ(found.behind + found.before + found.hidden + found.none, 0);
}

TEST(SeenThrough, LooksInTheRobotsExtentAlone) {
  Images images;
  images.robot.extent = {3, 2, 7, 5};
  EXPECT_EQ(images.read().at_surface, 12);
  images.robot.extent = {-5, 8, 4, 100};
  EXPECT_EQ(images.read().at_surface, 8) << "an extent may reach beyond the image";
  images.robot.extent = {};
  EXPECT_EQ(images.read().judged(), 0);
}

TEST(SeenThrough, OfALargeRobotItLooksAtRowsAllOverIt) {
  Images images(1280, 720);
  for (int v = 0; v < 720; ++v) std::fill_n(images.depth_m.row(v), v < 180 ? 1280 : 0, 3.0F);
  const RobotReadings found = images.read();
  EXPECT_LE(found.judged(), kMostReadPixels);
  EXPECT_GE(found.judged(), kMostReadPixels / 2);
  EXPECT_NEAR(found.seen_through(), 0.25, 0.05);
}

TEST(SeenThrough, WithoutAReadingThereIsNoShare) {
  Images images;
  images.depth_m = DepthImage(20, 10, kNoDepth);
  const RobotReadings found = images.read();
  EXPECT_EQ(found.none, 200);
  EXPECT_TRUE(std::isnan(found.seen_through()));
  EXPECT_TRUE(std::isnan(found.hidden_share()));
}

TEST(Agreement, TurnsAtTheKthOfTheLastN) {
  Agreement agreement(3, 4);
  const auto add = [&](bool verdict) {
    agreement.add(verdict);
    return agreement.state();
  };
  EXPECT_FALSE(add(true));
  EXPECT_FALSE(add(true));
  EXPECT_FALSE(add(false));
  EXPECT_TRUE(add(true)) << "three of four";
  EXPECT_TRUE(add(false)) << "two of four hold neither state, so it stays";
  EXPECT_TRUE(add(true));
  EXPECT_TRUE(add(false));
  EXPECT_FALSE(add(false)) << "three of four the other way";
}

TEST(Agreement, IsTheDefinitionOnRandomVerdicts) {
  for (const auto& [k, n] : {std::pair{1, 1}, {2, 3}, {10, 15}, {15, 15}, {8, 15}}) {
    sim::Random random(static_cast<std::uint32_t>(16 * n + k));
    Agreement agreement(k, n);
    std::deque<int> last(static_cast<std::size_t>(n), 0);
    bool state = false;
    int turns = 0;
    for (int i = 0; i < 3000; ++i) {
      const bool verdict = random.chance(i / 100 % 2 == 0 ? 0.15 : 0.85);
      agreement.add(verdict);
      last.pop_front();
      last.push_back(verdict);
      const int says_true = std::accumulate(last.begin(), last.end(), 0);
      const bool before = state;
      if (says_true >= k) state = true;
      if (n - says_true >= k) state = false;
      turns += state != before;
      ASSERT_EQ(agreement.state(), state) << k << " of " << n << ", verdict " << i;
    }
    EXPECT_GT(turns, 10);
  }
}

}  // namespace
}  // namespace berth
