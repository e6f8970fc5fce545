// Every method finds the minimum over all pairs, the lattices a pair that is never closer; exact on
// every instruction set that this machine has.
#include <cmath>

#include "tests/support/only_target.hpp"
#include "tests/support/thinned.hpp"
#include "tests/thesis/answer.hpp"
#include "tests/thesis/plain_definition.hpp"

namespace berth::testing {
namespace {

class Exactness : public MethodTest {
 protected:
  /// A quarter for methods on OpenGL, which software runs slowly.
  static std::uint32_t seeds(std::uint32_t count) {
    return thinned(runs_on_opengl(GetParam()) ? (count + 3) / 4 : count);
  }
  void expect_as_brute_force(const sim::ImagePair& images, double range_m = 1.0) const {
    const LinkDistances truth = answer(Method::brute_force, images, range_m);
    if (GetParam() != Method::exact) {
      expect_answer_of(GetParam(), truth, answer(GetParam(), images, range_m), images);
      return;
    }
    on_every_target([&](const char* target) {
      SCOPED_TRACE(target);
      expect_answer_of(GetParam(), truth, answer(GetParam(), images, range_m), images);
    });
  }
};
INSTANTIATE_TEST_SUITE_P(Methods, Exactness, ::testing::ValuesIn(kMethods), method_test_name);

struct Size {
  int width;
  int height;
};

TEST_P(Exactness, IsTheLeastPlainDistanceOnSmallRandomScenes) {
  for (std::uint32_t seed = 0; seed < seeds(30); ++seed) {
    SCOPED_TRACE(seed);
    const sim::ImagePair images = sim::random_images(seed, 60, 44, 3);
    const LinkDistances found = answer(GetParam(), images);
    for (const LinkDistance& link : found.links) {
      const auto least_m = plain_least_distance_m(images, link.id);
      const bool in_range = least_m && *least_m <= 1;
      if (!finds_the_closest(GetParam())) {
        EXPECT_TRUE(link.status != LinkStatus::ok || link.distance_m >= least_m.value() - 1e-5);
        continue;
      }
      EXPECT_EQ(link.status == LinkStatus::ok, in_range);
      if (in_range) {
        EXPECT_NEAR(link.distance_m, *least_m, 1e-5);
      }
    }
  }
}

TEST_P(Exactness, HoldsForImagesThatNoTileDivides) {
  for (const Size size : {Size{1, 1}, {7, 5}, {8, 8}, {33, 17}, {31, 64}, {129, 65}, {3, 200}}) {
    for (std::uint32_t seed = 0; seed < seeds(40); ++seed) {
      SCOPED_TRACE(std::to_string(size.width) + " x " + std::to_string(size.height) + " seed " +
                   std::to_string(seed));
      expect_as_brute_force(sim::random_images(seed, size.width, size.height, 3));
    }
  }
}

TEST_P(Exactness, HoldsForRandomScenes) {
  for (std::uint32_t seed = 100; seed < 100 + seeds(10); ++seed) {
    SCOPED_TRACE(seed);
    expect_as_brute_force(sim::random_images(seed, 240, 180, 8));
  }
}

/// With every 11th robot pixel only (thinned: every 110th), since brute force has to finish too.
TEST_P(Exactness, HoldsForAVgaScene) {
  constexpr int kEvery = 11 * (10 / thinned(10));
  sim::ImagePair images = sim::random_images(500, 640, 480, 8);
  for (int v = 0; v < 480; ++v) {
    for (int u = 0; u < 640; ++u) {
      if ((3 * u + 7 * v) % kEvery != 0) put_robot(images, u, v, kNoDepth, kNoLink);
    }
  }
  expect_as_brute_force(images);
}

TEST_P(Exactness, HoldsForAnyRange) {
  const sim::ImagePair images = sim::random_images(3, 160, 120, 6);
  for (const double range_m : {1e-3, 0.05, 0.2, 0.5, 3.0, 50.0}) {
    SCOPED_TRACE(range_m);
    expect_as_brute_force(images, range_m);
  }
}

TEST_P(Exactness, HoldsForRangesThatJustReachOrMiss) {
  for (std::uint32_t seed = 0; seed < seeds(60); ++seed) {
    SCOPED_TRACE(seed);
    const sim::ImagePair images = sim::random_images(seed, 70, 50, 3);
    for (const LinkDistance& link : answer(Method::brute_force, images, 3.0).links) {
      if (link.status != LinkStatus::ok || link.distance_m == 0) continue;
      for (const double share : {0.99, 1.0, 1.0001}) {
        expect_as_brute_force(images, share * link.distance_m);
      }
    }
  }
}

TEST_P(Exactness, HoldsFor64Links) { expect_as_brute_force(sim::random_images(8, 320, 240, 64)); }

TEST_P(Exactness, HoldsForARobotOverTheWholeImageBehindAndBeforeObstacles) {
  for (const float obstacle_m : {0.4f, 1.3f}) {
    sim::ImagePair images = sim::empty_images(97, 70, 4);
    for (int v = 0; v < 70; ++v) {
      for (int u = 0; u < 97; ++u) {
        put_robot(images, u, v, 1 + 0.001f * static_cast<float>((u * 7 + v * 13) % 50),
                  static_cast<LinkId>(1 + (u / 9 + v / 5) % 4));
      }
    }
    put_obstacle(images, {40, 30, 47, 33}, obstacle_m);
    expect_as_brute_force(images);
  }
}

TEST_P(Exactness, HoldsForCheckerboardsOfRobotAndObstacle) {
  for (const int cell : {1, 3, 8}) {
    sim::ImagePair images = sim::empty_images(70, 50, 2);
    for (int v = 0; v < 50; ++v) {
      for (int u = 0; u < 70; ++u) {
        if ((u / cell + v / cell) % 2 == 0) {
          put_robot(images, u, v, 1.0f, static_cast<LinkId>(1 + u % 2));
        } else {
          images.obstacle_depth_m(u, v) = 1.2f + 0.001f * static_cast<float>((u * v) % 17);
        }
      }
    }
    expect_as_brute_force(images);
  }
}

/// A robot plate before an obstacle plane; both may be tilted: almost every pair ties.
sim::ImagePair plates(float robot_tilt, float obstacle_tilt) {
  sim::ImagePair images = sim::empty_images(120, 90, 1);
  for (int v = 0; v < 90; ++v) {
    for (int u = 0; u < 120; ++u) {
      const float slope = static_cast<float>(u + v) / 210;
      images.obstacle_depth_m(u, v) = 1.3f + obstacle_tilt * slope;
      if (u > 30 && u < 80 && v > 20 && v < 60) put_robot(images, u, v, 1 + robot_tilt * slope);
    }
  }
  return images;
}

TEST_P(Exactness, HoldsForPlatesThatAreEverywhereAboutEquallyFar) {
  for (const float robot_tilt : {0.0f, 0.1f, -0.2f}) {
    for (const float obstacle_tilt : {0.0f, 0.1f, -0.2f}) {
      expect_as_brute_force(plates(robot_tilt, obstacle_tilt));
    }
  }
}

/// The range hardly holds the one pair, so a bound that is a little too large loses it.
TEST_P(Exactness, FindsTheOnlyPairWhereverItsPixelsLie) {
  for (int i = 0; i < 2000; ++i) {
    SCOPED_TRACE(i);
    sim::ImagePair images = sim::empty_images(40, 30, 1);
    images.camera.cx_px = i % 3 == 0 ? -15 : 12;
    const Pixel robot{(i * 7) % 40, (i * 11) % 30};
    const Pixel obstacle{(i * 13) % 40, (i * 17 + i / 40) % 30};
    const float robot_m = 0.8f + 0.01f * static_cast<float>(i % 40);
    const float obstacle_m = 0.9f + 0.013f * static_cast<float>(i % 97);
    put_robot(images, robot.u, robot.v, robot_m);
    images.obstacle_depth_m(obstacle.u, obstacle.v) = obstacle_m;
    const double distance_m = plain_distance_m(images.camera, robot, robot_m, obstacle, obstacle_m);
    const LinkDistance link = answer(GetParam(), images, distance_m * 1.00001 + 1e-6).links[0];
    ASSERT_EQ(link.status, LinkStatus::ok);
    EXPECT_NEAR(link.distance_m, distance_m, 1e-5);
  }
}

TEST_P(Exactness, HoldsForHugeAndTinyDepths) {
  for (const float scale : {0.05f, 60.0f, 1e6f}) {
    sim::ImagePair images = sim::random_images(42, 100, 80, 4);
    for (float& depth_m : images.robot.depth_m.pixels()) depth_m *= scale;
    for (float& depth_m : images.obstacle_depth_m.pixels()) depth_m *= scale;
    expect_as_brute_force(images, std::min(scale, 50.0f));
  }
}

TEST_P(Exactness, HoldsForNoiseWithoutAnyStructure) {
  sim::ImagePair images = sim::empty_images(90, 60, 5);
  std::uint32_t state = 1;
  const auto next = [&state] { return (state = state * 1664525u + 1013904223u) >> 8; };
  for (int v = 0; v < 60; ++v) {
    for (int u = 0; u < 90; ++u) {
      const float depth_m = 0.3f + 1e-7f * static_cast<float>(next());
      if (next() % 3 == 0) put_robot(images, u, v, depth_m, static_cast<LinkId>(1 + next() % 5));
      if (next() % 50 == 0) images.obstacle_depth_m(u, v) = depth_m + 0.3f;
    }
  }
  expect_as_brute_force(images);
}

TEST_P(Exactness, AnObstacleImageWithGapsBetweenItsRowsCountsWithoutThem) {
  const sim::ImagePair images = sim::random_images(5, 61, 40, 3);
  DepthImage wide(80, 40, 0.1f);
  for (int v = 0; v < 40; ++v) {
    for (int u = 0; u < 61; ++u) wide(u, v) = images.obstacle_depth_m(u, v);
  }
  const DepthView view{wide.row(0), 61, 40, 80};
  AnswerWorkspace workspace;
  LinkDistances out;
  answer(GetParam(), images, view, image_settings(1.0, false), workspace, out);
  expect_answer_of(GetParam(), answer(Method::brute_force, images), out, images);
}

}  // namespace
}  // namespace berth::testing
