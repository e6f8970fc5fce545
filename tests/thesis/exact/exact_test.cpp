// What `exact` promises beyond the answer that all methods have in common.
#include "thesis/exact/exact.hpp"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include "sim/random_images.hpp"
#include "tests/support/error_message.hpp"
#include "tests/support/image_settings.hpp"
#include "tests/support/only_target.hpp"
#include "tests/support/thinned.hpp"
#include "tests/thesis/exact/smooth_images.hpp"
#include "thesis/brute_force.hpp"

namespace berth::testing {
namespace {

void ask(const sim::ImagePair& images, ExactWorkspace& workspace, LinkDistances& out,
         const ImageDistanceSettings& settings = image_settings(1.0, false)) {
  SearchableDepth obstacles;
  obstacles.build(images.obstacle_depth_m);
  exact({images.camera, images.robot, images.link_count, obstacles, settings}, workspace, out);
}

LinkDistances true_answer(const sim::ImagePair& images) {
  LinkDistances out;
  brute_force({images.camera, images.robot, images.link_count,
               SearchableDepth(images.obstacle_depth_m), image_settings(1.0, false)},
              out);
  return out;
}

LinkDistances fresh_answer(const sim::ImagePair& images) {
  ExactWorkspace workspace;
  LinkDistances out;
  ask(images, workspace, out);
  return out;
}

void expect_same_distances(const LinkDistances& expected, const LinkDistances& found) {
  ASSERT_EQ(expected.links.size(), found.links.size());
  for (std::size_t i = 0; i < expected.links.size(); ++i) {
    SCOPED_TRACE("link " + std::to_string(i + 1));
    ASSERT_EQ(found.links[i].status, expected.links[i].status);
    EXPECT_EQ(found.links[i].robot_pixels, expected.links[i].robot_pixels);
    if (expected.links[i].status != LinkStatus::ok) continue;
    EXPECT_EQ(found.links[i].distance_m, expected.links[i].distance_m);
    EXPECT_EQ(found.links[i].lower_bound_m, expected.links[i].lower_bound_m);
  }
}

TEST(Exact, IsBruteForceWhereAllTilesTie) {
  for (const sim::ImagePair& images :
       {tilted_plates(0, 120, 90), tilted_plates(0.1, 120, 90), tilted_plates(-0.7, 120, 90),
        ball_in_shell(120, 90), bowl_in_shell(120, 90), bowl_in_shell(133, 101)}) {
    const LinkDistances truth = true_answer(images);
    on_every_target([&](const char* target) {
      SCOPED_TRACE(target);
      expect_same_distances(truth, fresh_answer(images));
    });
  }
}

/// Also where the obstacles stand before the robot, and partly so within one tile.
TEST(Exact, IsBruteForceWhereASlopeCutsThroughTheRobot) {
  for (const double tilt_rad : {0.2, 0.9}) {
    sim::ImagePair images = tilted_plates(tilt_rad, 120, 90);
    for (int v = 0; v < 90; ++v) {
      for (int u = 0; u < 120; ++u) {
        float& depth_m = images.obstacle_depth_m(u, v);
        if ((u + 2 * v) % 90 < 60) depth_m = kNoDepth;
        depth_m -= 0.004f * static_cast<float>(v);
      }
    }
    const LinkDistances truth = true_answer(images);
    expect_same_distances(truth, fresh_answer(images));
  }
}

TEST(Exact, TheLastAnswerChangesNoDistance) {
  ExactWorkspace workspace;
  LinkDistances out;
  for (std::uint32_t seed = 0; seed < thinned(40u); ++seed) {
    SCOPED_TRACE(seed);
    // Sizes and numbers of links change as well, so that old pixels lie outside or on other links.
    const int side = 40 + static_cast<int>(seed * 37 % 90);
    const sim::ImagePair images =
        sim::random_images(seed / 2, side + 20, side, 1 + static_cast<int>(seed % 5));
    ask(images, workspace, out);
    expect_same_distances(fresh_answer(images), out);
    ask(images, workspace, out);
    expect_same_distances(fresh_answer(images), out);
  }
}

TEST(Exact, TheLastAnswerSavesWork) {
  const sim::ImagePair images = sim::random_images(2, 320, 240, 6);
  ExactWorkspace workspace;
  LinkDistances out;
  ask(images, workspace, out);
  const std::int64_t first = out.pairs;
  ask(images, workspace, out);
  EXPECT_LT(out.pairs, first);
}

TEST(Exact, ThreadsChangeNothing) {
  const auto with_threads = [](int threads, const sim::ImagePair& images) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    return fresh_answer(images);
  };
  for (const sim::ImagePair& images :
       {sim::random_images(7, 240, 180, 8), sim::random_images(9, 160, 120, 40),
        bowl_in_shell(160, 120)}) {
    const LinkDistances one = with_threads(1, images);
    for (int i = 0; i < 5; ++i) {
      const LinkDistances two = with_threads(2, images);
      expect_same_distances(one, two);
      EXPECT_EQ(one.pairs, two.pairs);
    }
  }
}

TEST(Exact, LooksOnlyWhereTheRobotSaysItIs) {
  sim::ImagePair images = sim::random_images(3, 200, 150, 4);
  const LinkDistances everywhere = fresh_answer(images);
  PixelRect extent;
  for (int v = 0; v < 150; ++v) {
    for (int u = 0; u < 200; ++u) {
      if (images.robot.link_id(u, v) != kNoLink) extent = united(extent, {u, v, u + 1, v + 1});
    }
  }
  images.robot.extent = extent;
  expect_same_distances(everywhere, fresh_answer(images));
}

TEST(Exact, BadSettingsAreRefusedByName) {
  const sim::ImagePair images = sim::empty_images(4, 4, 1);
  const auto message_of = [&](const ImageDistanceSettings& settings) -> std::string {
    ExactWorkspace workspace;
    LinkDistances out;
    return error_message<std::invalid_argument>([&] { ask(images, workspace, out, settings); });
  };
  EXPECT_EQ(message_of(image_settings(1.0, false, -0.5)),
            "evaluation.tolerance_m: -0.5; expected a finite number of at least 0");
  EXPECT_NE(message_of(image_settings(1.0, false, HUGE_VAL)), "");
  EXPECT_EQ(message_of(image_settings(1.0, false, 0, -3.0)),
            "evaluation.deadline_us: -3; expected a number of at least 0");
  EXPECT_NE(message_of(image_settings(1.0, false, 0, std::nan(""))), "");
  EXPECT_EQ(message_of(image_settings(1.0, false, 0, HUGE_VAL)), "");
}

}  // namespace
}  // namespace berth::testing
