// What was dropped for its size and place, and how near each link is to it.
#include "berth/visibility/doubtful.hpp"

#include <gtest/gtest.h>

#include "berth/distance/brute_force.hpp"
#include "tests/support/random_images.hpp"

namespace berth {
namespace {

constexpr int kWidth_px = 96, kHeight_px = 72, kLinks = 4;

/// A question, and what its self filter dropped as doubtful: blocks of obstacle pixels at random.
struct DroppedScene {
  testing::ImagePair images;
  DepthImage sensor_depth_m;
  ObstacleImage obstacles;
};

DroppedScene dropped_scene(std::uint32_t seed) {
  DroppedScene scene{testing::random_images(seed, kWidth_px, kHeight_px, kLinks), {}, {}};
  scene.sensor_depth_m = scene.images.obstacle_depth_m;
  scene.obstacles.depth_m = scene.images.obstacle_depth_m;
  scene.obstacles.fate.resize(kWidth_px, kHeight_px, PixelFate::obstacle);
  for (int v = 0; v < kHeight_px; ++v) {
    for (int u = 0; u < kWidth_px; ++u) {
      const std::uint32_t block = (u / 6 * 7919 + v / 6 * 104729 + seed * 31) % 17;
      PixelFate& fate = scene.obstacles.fate(u, v);
      if (std::isnan(scene.sensor_depth_m(u, v))) {
        fate = PixelFate::no_reading;
      } else if (block < 8) {
        fate = block < 4 ? PixelFate::island : PixelFate::speckle;
        scene.obstacles.depth_m(u, v) = kNoDepth;
      } else if (block == 8) {
        fate = PixelFate::edge;
        scene.obstacles.depth_m(u, v) = kNoDepth;
      }
      ++scene.obstacles.count[static_cast<std::size_t>(fate)];
    }
  }
  return scene;
}

LinkDistances distances_to(const DroppedScene& scene, const DepthImage& depth_m, double range_m) {
  LinkDistances distances;
  brute_force({scene.images.camera,
               scene.images.robot,
               kLinks,
               SearchableDepth(depth_m),
               {.range_m = range_m}},
              distances);
  return distances;
}

TEST(Doubtful, IslandsAndSpeckleHaveTheirReadingAndNothingElseHasOne) {
  DroppedScene scene = dropped_scene(3);
  DoubtfulImage doubtful;
  find_doubtful(scene.sensor_depth_m, scene.obstacles, doubtful);
  doubtful.searchable.build(doubtful.depth_m);
  for (int v = 0; v < kHeight_px; ++v) {
    for (int u = 0; u < kWidth_px; ++u) {
      const PixelFate fate = scene.obstacles.fate(u, v);
      if (fate == PixelFate::island || fate == PixelFate::speckle) {
        ASSERT_EQ(doubtful.depth_m(u, v), scene.sensor_depth_m(u, v));
        ASSERT_TRUE(u >= doubtful.extent.u_begin && u < doubtful.extent.u_end);
        ASSERT_TRUE(v >= doubtful.extent.v_begin && v < doubtful.extent.v_end);
      } else {
        ASSERT_TRUE(std::isnan(doubtful.depth_m(u, v))) << u << " " << v;
      }
    }
  }
}

TEST(Doubtful, NothingStaysFromTheImageBefore) {
  DroppedScene scene = dropped_scene(3);
  DoubtfulImage doubtful;
  find_doubtful(scene.sensor_depth_m, scene.obstacles, doubtful);
  doubtful.searchable.build(doubtful.depth_m);
  ASSERT_FALSE(doubtful.extent.empty());
  scene.obstacles.count = {};
  scene.obstacles.fate.resize(kWidth_px, kHeight_px, PixelFate::obstacle);
  find_doubtful(scene.sensor_depth_m, scene.obstacles, doubtful);
  doubtful.searchable.build(doubtful.depth_m);
  EXPECT_TRUE(doubtful.extent.empty());
  for (const float depth_m : doubtful.depth_m.pixels()) ASSERT_TRUE(std::isnan(depth_m));
}

TEST(Doubtful, ANewSizeIsTaken) {
  DroppedScene scene = dropped_scene(3);
  DoubtfulImage doubtful;
  find_doubtful(scene.sensor_depth_m, scene.obstacles, doubtful);
  doubtful.searchable.build(doubtful.depth_m);
  clear_doubtful(10, 20, doubtful);
  EXPECT_TRUE(doubtful.extent.empty());
  EXPECT_EQ(doubtful.depth_m.width(), 10);
  EXPECT_EQ(doubtful.depth_m.height(), 20);
}

TEST(Doubtful, TheNearerOfBothDistancesIsThatOfTheImageFromWhichNothingDoubtfulWasDropped) {
  int doubts = 0, none = 0;
  DoubtfulImage doubtful;
  DoubtfulWorkspace workspace;
  for (std::uint32_t seed = 0; seed < 40; ++seed) {
    const DroppedScene scene = dropped_scene(seed);
    const double range_m = seed % 2 == 0 ? 1.0 : 0.1;
    DepthImage all_m = scene.obstacles.depth_m;
    find_doubtful(scene.sensor_depth_m, scene.obstacles, doubtful);
    doubtful.searchable.build(doubtful.depth_m);
    for (int i = 0; i < kWidth_px * kHeight_px; ++i) {
      const float depth_m = doubtful.depth_m.pixels()[i];
      if (!std::isnan(depth_m)) all_m.pixels()[i] = depth_m;
    }
    const LinkDistances kept = distances_to(scene, scene.obstacles.depth_m, range_m);
    const LinkDistances all = distances_to(scene, all_m, range_m);
    // Nothing of an answer before may stay.
    LinkVisibility before;
    before.doubtful_distance_m = 0.001F;
    std::vector<LinkVisibility> links(kLinks, before);
    find_doubtful_distances(scene.images.camera, scene.images.robot, doubtful, kept, range_m,
                            workspace, links);
    for (int i = 0; i < kLinks; ++i) {
      if (std::isnan(links[i].doubtful_distance_m)) {
        ++none;
        EXPECT_EQ(kept.links[i].status, all.links[i].status);
        if (kept.links[i].status == LinkStatus::ok) {
          EXPECT_NEAR(kept.links[i].distance_m, all.links[i].distance_m, 1e-5);
        }
        EXPECT_EQ(links[i].doubtful_pixel, Pixel());
        continue;
      }
      ++doubts;
      EXPECT_NEAR(links[i].doubtful_distance_m, all.links[i].distance_m, 1e-5);
      const Pixel p = links[i].doubtful_pixel;
      EXPECT_FALSE(std::isnan(doubtful.depth_m(p.u, p.v)));
    }
  }
  EXPECT_GT(doubts, 20);
  EXPECT_GT(none, 20);
}

}  // namespace
}  // namespace berth
