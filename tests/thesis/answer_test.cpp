// What an answer says, whatever the method.
#include <fmt/format.h>

#include <cmath>
#include <limits>

#include "tests/support/thinned.hpp"
#include "tests/thesis/answer.hpp"

namespace berth::testing {
namespace {

class Answer : public MethodTest {
 protected:
  LinkDistance only_link(const sim::ImagePair& images, double range_m = 1.0) const {
    return answer(GetParam(), images, range_m).links.at(0);
  }
};
INSTANTIATE_TEST_SUITE_P(Methods, Answer, ::testing::ValuesIn(kMethods), method_test_name);

/// What follows from finding the minimum.
class ExactAnswer : public Answer {};
INSTANTIATE_TEST_SUITE_P(Methods, ExactAnswer, ::testing::ValuesIn(kExactMethods),
                         method_test_name);

TEST_P(Answer, WithoutRobotEveryLinkIsNotVisible) {
  sim::ImagePair images = sim::empty_images(50, 40, 3);
  put_obstacle(images, {0, 0, 50, 40}, 1.0f);
  const LinkDistances found = answer(GetParam(), images);
  ASSERT_EQ(found.links.size(), 3u);
  EXPECT_EQ(found.pairs, 0);
  for (const LinkDistance& link : found.links) {
    EXPECT_EQ(link.status, LinkStatus::not_visible);
    EXPECT_EQ(link.robot_pixels, 0);
    expect_no_distance(link);
  }
}

TEST_P(Answer, WithoutObstacleAVisibleLinkHasNoneInRange) {
  sim::ImagePair images = sim::empty_images(50, 40, 2);
  put_robot(images, 20, 10, 1.0f, 2);
  const LinkDistances found = answer(GetParam(), images);
  EXPECT_EQ(found.links[0].status, LinkStatus::not_visible);
  EXPECT_EQ(found.links[1].status, LinkStatus::none_in_range);
  EXPECT_EQ(found.links[1].robot_pixels, 1);
  expect_no_distance(found.links[1]);
}

TEST_P(Answer, NoLinksGiveNoAnswers) {
  EXPECT_TRUE(answer(GetParam(), sim::empty_images(20, 20, 0)).links.empty());
}

TEST_P(Answer, EnvironmentPixelsAreNotEvaluated) {
  sim::ImagePair images = sim::empty_images(50, 40, 1);
  for (int u = 0; u < 50; ++u) put_robot(images, u, 10, 1.0f, kEnvironmentLink);
  put_robot(images, 20, 30, 1.0f, 1);
  put_obstacle(images, {20, 11, 21, 12}, 1.0f);
  EXPECT_EQ(only_link(images).robot_pixels, 1);
  EXPECT_EQ(only_link(images).obstacle_pixel, (Pixel{20, 11}));
  EXPECT_NEAR(only_link(images).distance_m, 18 / images.camera.fy_px, 1e-6);
}

TEST_P(Answer, TouchingIsDistanceZero) {
  sim::ImagePair images = sim::empty_images(50, 40, 1);
  put_robot(images, 20, 10, 1.0f);
  put_obstacle(images, {21, 11, 22, 12}, 1.0f);
  EXPECT_EQ(only_link(images).status, LinkStatus::ok);
  EXPECT_EQ(only_link(images).distance_m, 0);
  EXPECT_EQ(only_link(images, 1e-30).distance_m, 0);
}

TEST_P(Answer, ANearPlateOverTheRobotTouchesIt) {
  sim::ImagePair images = sim::empty_images(50, 40, 1);
  put_robot(images, 20, 10, 1.0f);
  put_obstacle(images, {0, 0, 50, 40}, 0.3f);
  EXPECT_EQ(only_link(images).distance_m, 0);
}

TEST_P(Answer, AnObstacleInFrontOfTheRobotCountsAtTheRobotsDepth) {
  sim::ImagePair images = sim::empty_images(50, 40, 1);
  put_robot(images, 20, 10, 1.0f);
  put_obstacle(images, {31, 10, 32, 11}, 0.2f);
  EXPECT_NEAR(only_link(images).distance_m, 10 / images.camera.fx_px, 1e-6);
  EXPECT_NEAR(only_link(images).obstacle_point_C_m.z(), 1.0, 1e-6);
}

TEST_P(Answer, TheRangeIsPartOfTheRange) {
  sim::ImagePair images = sim::empty_images(64, 64, 1);
  put_robot(images, 5, 9, 1.37f);
  put_obstacle(images, {50, 40, 51, 41}, 1.71f);
  const float distance_m = only_link(images, 2.0).distance_m;
  const float below_m = std::nextafter(distance_m, 0.0f);
  EXPECT_EQ(only_link(images, distance_m).status, LinkStatus::ok);
  EXPECT_EQ(only_link(images, distance_m).distance_m, distance_m);
  EXPECT_EQ(only_link(images, below_m).status, LinkStatus::none_in_range);
  expect_no_distance(only_link(images, below_m));
}

TEST_P(ExactAnswer, TheRangeIsPartOfTheRangeOnRandomScenes) {
  for (std::uint32_t seed = 0; seed < thinned(30u); ++seed) {
    const sim::ImagePair images = sim::random_images(seed, 64, 48, 1);
    const LinkDistance link = only_link(images, 5.0);
    if (link.status != LinkStatus::ok || link.distance_m == 0) continue;
    EXPECT_EQ(only_link(images, link.distance_m).distance_m, link.distance_m);
    EXPECT_EQ(only_link(images, std::nextafter(link.distance_m, 0.0f)).status,
              LinkStatus::none_in_range);
  }
}

TEST_P(Answer, ALargerRangeNeverChangesADistance) {
  const sim::ImagePair images = sim::random_images(11, 160, 120, 6);
  const LinkDistances near = answer(GetParam(), images, 0.4);
  const LinkDistances far = answer(GetParam(), images, 4.0);
  for (std::size_t i = 0; i < near.links.size(); ++i) {
    if (near.links[i].status != LinkStatus::ok) continue;
    EXPECT_EQ(near.links[i].distance_m, far.links[i].distance_m);
  }
}

TEST_P(ExactAnswer, AnotherObstaclePixelNeverIncreasesADistance) {
  sim::ImagePair images = sim::random_images(21, 96, 72, 4);
  LinkDistances before = answer(GetParam(), images, 5.0);
  for (int i = 0; i < 60; ++i) {
    const int u = (i * 37) % 96;
    const int v = (i * 23) % 72;
    if (!std::isnan(images.obstacle_depth_m(u, v))) continue;
    images.obstacle_depth_m(u, v) = 0.5f + 0.03f * static_cast<float>(i);
    const LinkDistances after = answer(GetParam(), images, 5.0);
    for (std::size_t k = 0; k < after.links.size(); ++k) {
      if (before.links[k].status != LinkStatus::ok) continue;
      ASSERT_EQ(after.links[k].status, LinkStatus::ok);
      EXPECT_LE(after.links[k].distance_m, before.links[k].distance_m);
    }
    before = after;
  }
}

template <class T>
void mirror(Image<T>& image) {
  for (int v = 0; v < image.height(); ++v) std::reverse(image.row(v), image.row(v) + image.width());
}

/// Leaves the pixels of every 4th column only. Mirroring swaps a pixel's sides, and the metric
/// takes pixels of the same column at their left side.
void keep_separate_columns(sim::ImagePair& images) {
  for (int v = 0; v < images.camera.height_px; ++v) {
    for (int u = 0; u < images.camera.width_px; ++u) {
      if (u % 4 != 0) put_robot(images, u, v, kNoDepth, kNoLink);
      if (u % 4 != 2) images.obstacle_depth_m(u, v) = kNoDepth;
    }
  }
}

TEST_P(ExactAnswer, AMirroredSceneHasTheSameDistances) {
  for (std::uint32_t seed = 0; seed < thinned(20u); ++seed) {
    SCOPED_TRACE(seed);
    sim::ImagePair images = sim::random_images(seed, 131, 90, 5);
    keep_separate_columns(images);
    const LinkDistances before = answer(GetParam(), images);
    images.camera.cx_px = images.camera.width_px - 1 - images.camera.cx_px;
    mirror(images.robot.depth_m);
    mirror(images.robot.link_id);
    mirror(images.obstacle_depth_m);
    expect_same_answer(before, answer(GetParam(), images), images);
  }
}

bool identical(float a, float b) { return a == b || (std::isnan(a) && std::isnan(b)); }

TEST_P(Answer, AUsedWorkspaceGivesTheAnswerOfAFreshOne) {
  const sim::ImagePair scenes[] = {
      sim::random_images(1, 160, 120, 8), sim::random_images(2, 65, 200, 3),
      sim::empty_images(9, 5, 1),         sim::random_images(4, 160, 120, 8),
      sim::random_images(1, 160, 120, 8), sim::random_images(7, 20, 20, 64)};
  AnswerWorkspace workspace;
  LinkDistances out;
  for (const sim::ImagePair& images : scenes) {
    answer(GetParam(), images, images.obstacle_depth_m, image_settings(1.0, false), workspace, out);
    const LinkDistances fresh = answer(GetParam(), images);
    ASSERT_EQ(out.links.size(), fresh.links.size());
    EXPECT_EQ(out.pairs, fresh.pairs);
    for (std::size_t i = 0; i < fresh.links.size(); ++i) {
      EXPECT_EQ(out.links[i].status, fresh.links[i].status);
      EXPECT_EQ(out.links[i].robot_pixel, fresh.links[i].robot_pixel);
      EXPECT_EQ(out.links[i].obstacle_pixel, fresh.links[i].obstacle_pixel);
      EXPECT_TRUE(identical(out.links[i].distance_m, fresh.links[i].distance_m));
    }
  }
}

TEST_P(Answer, TheHighestLinkIdIsEvaluated) {
  sim::ImagePair images = sim::empty_images(20, 20, 65534);
  put_robot(images, 3, 3, 1.0f, 65534);
  put_obstacle(images, {10, 3, 11, 4}, 1.0f);
  const LinkDistances found = answer(GetParam(), images);
  EXPECT_EQ(found.links[65533].status, LinkStatus::ok);
  EXPECT_EQ(found.links[65533].id, 65534);
  EXPECT_EQ(found.links[0].status, LinkStatus::not_visible);
}

TEST_P(Answer, ARangeThatIsNoLengthIsRefusedByName) {
  for (const double range_m : {0.0, -1.0, std::numeric_limits<double>::infinity(),
                               std::numeric_limits<double>::quiet_NaN()}) {
    try {
      answer(GetParam(), sim::empty_images(4, 4, 1), range_m);
      FAIL() << range_m;
    } catch (const std::invalid_argument& error) {
      EXPECT_NE(std::string(error.what()).find("range_m"), std::string::npos);
      EXPECT_NE(std::string(error.what()).find(fmt::format("range_m: {};", range_m)),
                std::string::npos);
    }
  }
}

TEST(Methods, HaveNames) {
  for (const Method method : kMethods) EXPECT_EQ(method_from_name(name_of(method)), method);
  EXPECT_EQ(method_from_name("exact"), Method::exact);
  EXPECT_EQ(method_from_name("brute_force"), Method::brute_force);
  EXPECT_EQ(method_from_name("Exact"), std::nullopt);
  EXPECT_EQ(method_from_name(""), std::nullopt);
}

TEST(BranchAndBound, ComputesFewOfThePairs) {
  const sim::ImagePair images = sim::random_images(12, 240, 180, 8);
  EXPECT_LT(answer(Method::exact, images).pairs, answer(Method::brute_force, images).pairs / 100);
}

}  // namespace
}  // namespace berth::testing
