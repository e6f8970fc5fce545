// fill_mean_directions() against its slow twin, on every instruction set that this machine has.
#include <cmath>
#include <random>

#include "tests/support/only_target.hpp"
#include "tests/thesis/mean_direction/plain_mean.hpp"

namespace berth::testing {
namespace {

class MeanDirectionAccuracy : public ::testing::TestWithParam<std::int64_t> {
 private:
  OnlyTarget only_{GetParam()};
};

std::vector<std::int64_t> all_targets() {
  std::vector<std::int64_t> targets;
  for (std::int64_t left = hwy::SupportedTargets(); left != 0; left &= left - 1) {
    targets.push_back(left & -left);
  }
  return targets;
}

std::string target_test_name(const ::testing::TestParamInfo<std::int64_t>& target) {
  return hwy::TargetName(target.param);
}

INSTANTIATE_TEST_SUITE_P(Targets, MeanDirectionAccuracy, ::testing::ValuesIn(all_targets()),
                         target_test_name);

/// A robot of one pixel for each link, spread over the image.
sim::ImagePair scattered_robot(int width, int height, std::uint32_t seed) {
  sim::ImagePair images = sim::empty_images(width, height, 6);
  std::mt19937 random(seed);
  for (LinkId link = 1; link <= 6; ++link) {
    put_robot(images, static_cast<int>(random() % width), static_cast<int>(random() % height),
              0.6f + 0.2f * static_cast<float>(link), link);
  }
  return images;
}

/// Sets each obstacle pixel to depth_m(u, v).
template <class Depth>
void draw(sim::ImagePair& images, Depth depth_m) {
  for (int v = 0; v < images.obstacle_depth_m.height(); ++v) {
    for (int u = 0; u < images.obstacle_depth_m.width(); ++u) {
      images.obstacle_depth_m(u, v) = static_cast<float>(depth_m(u, v));
    }
  }
}

TEST_P(MeanDirectionAccuracy, HoldsForRandomScenes) {
  int links = 0;
  for (std::uint32_t seed = 0; seed < 12; ++seed) {
    for (const double range_m : {0.3, 1.0, 4.0}) {
      links += expect_plain_means(sim::random_images(seed, 123, 90, 4), range_m);
    }
  }
  EXPECT_GT(links, 50);
}

TEST_P(MeanDirectionAccuracy, IsMuchBetterWhereMostTilesAreFar) {
  int links = 0;
  for (std::uint32_t seed = 0; seed < 6; ++seed) {
    links += expect_plain_means(sim::random_images(seed, 640, 480, 3), 2.0, 5e-4);
  }
  EXPECT_GT(links, 9);
}

TEST_P(MeanDirectionAccuracy, HoldsForDepthsOfNoStructure) {
  for (const double holes : {0.0, 0.1, 0.9}) {
    sim::ImagePair images = scattered_robot(131, 97, 1);
    std::mt19937 random(2);
    const auto uniform = [&] { return random() / 4294967296.0; };
    draw(images, [&](int, int) { return uniform() < holes ? NAN : 0.3 + 3 * uniform(); });
    EXPECT_GT(expect_plain_means(images, 1.0), 0);
    EXPECT_GT(expect_plain_means(images, 9.0), 0);
  }
}

TEST_P(MeanDirectionAccuracy, HoldsForCheckerboards) {
  for (const int square_px : {1, 3, 4, 8, 11}) {
    sim::ImagePair images = scattered_robot(128, 96, 3);
    draw(images,
         [&](int u, int v) { return (u / square_px + v / square_px) % 2 == 0 ? 0.9 : 2.3; });
    EXPECT_GT(expect_plain_means(images, 3.0), 0);
    draw(images,
         [&](int u, int v) { return (u / square_px + v / square_px) % 2 == 0 ? NAN : 2.3; });
    EXPECT_GT(expect_plain_means(images, 3.0), 0);
  }
}

TEST_P(MeanDirectionAccuracy, HoldsInFrontOfTheRobotAndAcrossItsDepth) {
  sim::ImagePair images = scattered_robot(200, 150, 4);
  draw(images, [](int, int) { return 0.4; });
  EXPECT_EQ(expect_plain_means(images, 5.0), 6);
  draw(images, [](int u, int v) { return 0.5 + 0.01 * u + 0.001 * v; });
  EXPECT_EQ(expect_plain_means(images, 5.0), 6);
}

TEST_P(MeanDirectionAccuracy, HoldsForSteepPlanes) {
  for (const double slope : {0.0, 0.003, 0.02, 0.1}) {
    sim::ImagePair images = scattered_robot(160, 120, 5);
    draw(images, [&](int u, int v) { return 2.2 + slope * (u + v); });
    EXPECT_EQ(expect_plain_means(images, 50.0), 6);
  }
}

TEST_P(MeanDirectionAccuracy, HoldsForDepthEdgesAtEveryPlaceInATile) {
  for (int edge_px = 40; edge_px < 48; ++edge_px) {
    sim::ImagePair images = scattered_robot(96, 80, 6);
    draw(images, [&](int u, int v) { return u < edge_px ? 1.1 : v < edge_px ? 2.5 : 4.0; });
    EXPECT_EQ(expect_plain_means(images, 6.0), 6);
  }
}

TEST_P(MeanDirectionAccuracy, HoldsWhereTheFarthestDepthAndTheRegionCutTiles) {
  sim::ImagePair images = scattered_robot(256, 192, 7);
  draw(images, [](int u, int v) { return 1.0 + 0.002 * u + 0.004 * v; });
  for (const double range_m : {0.11, 0.2, 0.37, 0.6}) expect_plain_means(images, range_m);
}

TEST_P(MeanDirectionAccuracy, HoldsInContact) {
  sim::ImagePair images = scattered_robot(64, 64, 8);
  for (float& depth_m : images.obstacle_depth_m.pixels()) depth_m = 1.0f;
  EXPECT_EQ(expect_plain_means(images, 2.0), 6);
  put_robot(images, 31, 32, 1.0f);
  EXPECT_EQ(expect_plain_means(images, 2.0), 6);
}

TEST_P(MeanDirectionAccuracy, HoldsForEverySmallSizeOfImage) {
  for (int width = 1; width < 40; width += 3) {
    for (int height = 1; height < 20; height += 4) {
      sim::ImagePair images = sim::empty_images(width, height, 1);
      put_robot(images, width / 2, height / 3, 0.8f);
      draw(images, [](int u, int v) { return 0.7 + 0.05 * (u % 7) + 0.02 * v; });
      EXPECT_EQ(expect_plain_means(images, 3.0), width * height == 1 ? 0 : 1);
    }
  }
}

TEST_P(MeanDirectionAccuracy, HoldsForASmallAndForALargeAngleOfView) {
  for (const double focal_px : {30.0, 100.0, 3000.0}) {
    sim::ImagePair images = scattered_robot(160, 120, 9);
    images.camera.fx_px = focal_px;
    images.camera.fy_px = 1.3 * focal_px;
    std::mt19937 random(3);
    draw(images, [&](int u, int) { return 1.9 + 0.002 * u + 1e-11 * random(); });
    EXPECT_EQ(expect_plain_means(images, 40.0), 6);
  }
}

TEST_P(MeanDirectionAccuracy, HoldsForTinyDepths) {
  sim::ImagePair images = scattered_robot(40, 30, 10);
  for (float& depth_m : images.robot.depth_m.pixels()) depth_m *= 1e-9f;
  draw(images, [](int u, int v) { return 1e-9 * (0.5 + 0.02 * u + 0.01 * v); });
  EXPECT_EQ(expect_plain_means(images, 1.0), 6);
}

}  // namespace
}  // namespace berth::testing
