// What the thesis's evaluator promises, and how far it may be trusted.
#include "thesis/lattice/lattice.hpp"

#include <cmath>
#include <cstdio>
#include <limits>
#include <stdexcept>

#include "tests/support/shared_gl.hpp"
#include "tests/support/thinned.hpp"
#include "tests/thesis/answer.hpp"
#include "tests/thesis/close_share.hpp"
#include "thesis/obstacle_tree.hpp"

namespace berth::testing {
namespace {

ImageDistanceSettings settings_with(LatticeSettings lattice,
                                    SurveillanceSettings surveillance = {}) {
  ImageDistanceSettings settings;
  settings.mean_direction = false;
  settings.lattice = lattice;
  settings.surveillance = surveillance;
  return settings;
}

const LatticeSettings kManyLattices[] = {{1, 1, 40, 2},   {2, 3, 60, 1},    {4, 4, 5, 3},
                                         {8, 32, 100, 2}, {65536, 1, 7, 7}, {1, 65536, 65536, 1}};

TEST(Lattice, IsNeverBelowBruteForceWhateverItsSettings) {
  for (std::uint32_t seed = 0; seed < thinned(12u); ++seed) {
    const sim::ImagePair images = sim::random_images(seed, 131, 97, 5);
    const LinkDistances truth = answer(Method::brute_force, images);
    for (const LatticeSettings& lattice : kManyLattices) {
      for (const SurveillanceRegion region : kSurveillanceRegions) {
        for (const DepthInterval interval : kDepthIntervals) {
          for (const SearchPattern pattern : kSearchPatterns) {
            expect_possible_answer(truth,
                                   answer(Method::lattice, images,
                                          settings_with(lattice, {region, interval, pattern})),
                                   images);
          }
        }
      }
    }
  }
}

TEST(Lattice, GivesTheSameDistancesInEachPattern) {
  for (std::uint32_t seed = 0; seed < thinned(20u); ++seed) {
    SCOPED_TRACE(seed);
    const sim::ImagePair images = sim::random_images(seed, 160, 120, 6);
    for (const LatticeSettings& lattice : kManyLattices) {
      const LinkDistances by_rows = answer(Method::lattice, images, settings_with(lattice));
      for (const SearchPattern pattern : kSearchPatterns) {
        const LinkDistances found =
            answer(Method::lattice, images, settings_with(lattice, {.search_pattern = pattern}));
        for (std::size_t i = 0; i < found.links.size(); ++i) {
          ASSERT_EQ(found.links[i].status, by_rows.links[i].status);
          if (found.links[i].status != LinkStatus::ok) continue;
          EXPECT_EQ(found.links[i].robot_pixel, by_rows.links[i].robot_pixel);
          EXPECT_EQ(found.links[i].distance_m, by_rows.links[i].distance_m);
        }
      }
    }
  }
}

TEST(Lattice, IsExactWhereTheLastStepHasAllPixelsOfTheLink) {
  for (std::uint32_t seed = 0; seed < thinned(20u); ++seed) {
    SCOPED_TRACE(seed);
    const sim::ImagePair images = sim::random_images(seed, 90, 70, 4);
    ImageDistanceSettings settings = settings_with({1, 1, 200, 200});
    settings.range_m = 50;
    const LinkDistances truth = answer(Method::brute_force, images, 50);
    const LinkDistances found = answer(Method::lattice, images, settings);
    for (std::size_t i = 0; i < truth.links.size(); ++i) {
      ASSERT_EQ(found.links[i].status, truth.links[i].status);
      if (truth.links[i].status != LinkStatus::ok) continue;
      EXPECT_EQ(found.links[i].distance_m, truth.links[i].distance_m);
    }
  }
}

TEST(Lattice, IsExactForLinksOfOnePixel) {
  for (std::uint32_t seed = 0; seed < thinned(40u); ++seed) {
    SCOPED_TRACE(seed);
    const sim::ImagePair scene = sim::random_images(seed, 80, 60, 1);
    sim::ImagePair images = scene;
    images.robot = sim::empty_images(80, 60, 1).robot;
    images.link_count = 6;
    for (int i = 0; i < 6; ++i) {
      put_robot(images, (i * 31 + static_cast<int>(seed)) % 80, (i * 17) % 60,
                0.4f + 0.3f * static_cast<float>(i), static_cast<LinkId>(i + 1));
    }
    const LinkDistances truth = answer(Method::brute_force, images);
    const LinkDistances found = answer(Method::lattice, images);
    for (std::size_t i = 0; i < truth.links.size(); ++i) {
      ASSERT_EQ(found.links[i].status, truth.links[i].status);
      if (truth.links[i].status != LinkStatus::ok) continue;
      EXPECT_EQ(found.links[i].distance_m, truth.links[i].distance_m);
    }
  }
}

/// A bar with an obstacle beside its end: refinement has to walk there.
TEST(Lattice, FindsTheEndOfALongLink) {
  sim::ImagePair images = sim::empty_images(640, 480, 1);
  for (int u = 50; u < 500; ++u) {
    for (int v = 200; v < 230; ++v) put_robot(images, u, v, 1.0f);
  }
  put_obstacle(images, {520, 190, 540, 240}, 1.0f);
  const LinkDistance link = answer(Method::lattice, images).links[0];
  EXPECT_EQ(link.robot_pixel.u, 499);
  EXPECT_FLOAT_EQ(link.distance_m, static_cast<float>(20 / images.camera.fx_px));
}

TEST(Lattice, TheLastStepPassesOverNoObstaclePixel) {
  sim::ImagePair images = sim::empty_images(200, 100, 1);
  put_robot(images, 100, 50, 1.0f);
  put_obstacle(images, {113, 43, 140, 49}, 1.0f);
  const LinkDistance link = answer(Method::lattice, images, settings_with({4, 5, 40, 2})).links[0];
  EXPECT_EQ(link.obstacle_pixel, (Pixel{113, 48}));
}

/// Why steps are dangerous, and the default is 1.
TEST(Lattice, StepsPassOverAThinObstacleThatTheFirstSearchDoesNotMeet) {
  sim::ImagePair images = sim::empty_images(200, 100, 1);
  put_robot(images, 100, 50, 1.0f);
  put_obstacle(images, {117, 0, 118, 100}, 1.0f);
  const auto status = [&](int step_x, int step_y) {
    return answer(Method::lattice, images, settings_with({step_x, step_y, 40, 2})).links[0].status;
  };
  EXPECT_EQ(status(1, 1), LinkStatus::ok);
  EXPECT_EQ(status(1, 4), LinkStatus::ok);
  EXPECT_EQ(status(4, 1), LinkStatus::none_in_range);
}

constexpr int kLargeScenes = thinned(100);

/// Of scenes as large as the thesis's.
TEST(Lattice, IsWithin5MillimetresForNineOfTenLinks) {
  CloseShare share;
  std::int64_t pairs = 0;
  for (int seed = 0; seed < kLargeScenes; ++seed) {
    const sim::ImagePair images = sim::random_images(seed, 640, 480, 8);
    const LinkDistances found = answer(Method::lattice, images, settings_with({}));
    share.add(answer(Method::exact, images), found);
    pairs += found.pairs;
  }
  std::printf("%d of %d links within 5 mm, %lld pairs per scene\n", share.close, share.links,
              static_cast<long long>(pairs / kLargeScenes));
  EXPECT_GT(share.links, 6 * kLargeScenes);
  EXPECT_GE(share.close, 0.9 * share.links);
}

std::int64_t pairs_of_scenes(const LatticeSettings& lattice, SurveillanceRegion region) {
  std::int64_t pairs = 0;
  for (std::uint32_t seed = 0; seed < thinned(30u); ++seed) {
    pairs += answer(Method::lattice, sim::random_images(seed, 240, 180, 6),
                    settings_with(lattice, {.region = region}))
                 .pairs;
  }
  return pairs;
}

/// On one scene a larger step can cost pairs: the region shrinks later.
TEST(Lattice, LargerStepsComputeFewerPairs) {
  for (const SurveillanceRegion region : kSurveillanceRegions) {
    std::int64_t last = std::numeric_limits<std::int64_t>::max();
    for (const int step : {1, 2, 4}) {
      const std::int64_t pairs = pairs_of_scenes({step, step, 40, 2}, region);
      EXPECT_LT(pairs, last);
      last = pairs;
    }
  }
}

/// The last step grows with the square of its radius; a radius of 1 takes one lattice more than 2.
TEST(Lattice, ALargerFinalRadiusComputesMorePairs) {
  std::int64_t last = 0;
  for (const int radius_px : {2, 4, 8}) {
    const std::int64_t pairs = pairs_of_scenes({1, 1, 40, radius_px}, SurveillanceRegion::image);
    EXPECT_GT(pairs, last);
    last = pairs;
  }
}

/// Beyond, a first lattice of a point or two has hardly fewer, and refinement costs more.
TEST(Lattice, ALargerFirstRadiusComputesFewerPairsUpToThatOfTheLinks) {
  std::int64_t last = std::numeric_limits<std::int64_t>::max();
  for (const int radius_px : {3, 5, 10, 20}) {
    const std::int64_t pairs = pairs_of_scenes({1, 1, radius_px, 2}, SurveillanceRegion::image);
    EXPECT_LT(pairs, last);
    last = pairs;
  }
}

TEST(Lattice, ASmallerRegionComputesFewerPairs) {
  const std::int64_t image = pairs_of_scenes({}, SurveillanceRegion::image);
  const std::int64_t cube = pairs_of_scenes({}, SurveillanceRegion::cube_projection);
  EXPECT_LT(cube, image);
}

TEST(Lattice, RefusesSettingsOutsideTheirDomainByName) {
  struct Bad {
    LatticeSettings lattice;
    std::string name;
    std::string value;
  };
  for (const Bad& bad : {Bad{{0, 1, 40, 2}, "step_x", "0"},
                         {{1, -3, 40, 2}, "step_y", "-3"},
                         {{65537, 1, 40, 2}, "step_x", "65537"},
                         {{1, 1, 0, 2}, "initial_grid_radius_px", "0"},
                         {{1, 1, 65537, 2}, "initial_grid_radius_px", "65537"},
                         {{1, 1, 40, 0}, "final_grid_radius_px", "0"},
                         {{1, 1, 40, 41}, "final_grid_radius_px", "from 1 to 40"},
                         {{1, 1, 40, 2, 0}, "tile_px", "0"},
                         {{1, 1, 40, 2, 65}, "tile_px", "from 1 to 64"}}) {
    for (const Method method : kMethods) {
      if (runs_on_opengl(method) && !shared_gl()) continue;
      try {
        answer(method, sim::empty_images(4, 4, 1), settings_with(bad.lattice));
        FAIL() << bad.name;
      } catch (const std::invalid_argument& error) {
        EXPECT_NE(std::string(error.what()).find(bad.name), std::string::npos) << error.what();
        EXPECT_NE(std::string(error.what()).find(bad.value), std::string::npos) << error.what();
      }
    }
  }
}

}  // namespace
}  // namespace berth::testing
