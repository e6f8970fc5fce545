// The search around one robot pixel, and brute_force with a region.
#include "thesis/surveillance.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "thesis/region_of_surveillance.hpp"

#include "tests/support/thinned.hpp"
#include "tests/thesis/answer.hpp"

namespace berth::testing {
namespace {

ImageDistanceSettings settings_with(SurveillanceSettings surveillance, double range_m = 1.0) {
  ImageDistanceSettings settings = image_settings(range_m, false);
  settings.surveillance = surveillance;
  return settings;
}

class BruteForceWithARegion : public ::testing::TestWithParam<SearchPattern> {
 protected:
  SurveillanceSettings cube(DepthInterval interval = DepthInterval::gray_area) const {
    return {SurveillanceRegion::cube_projection, interval, GetParam()};
  }
};
INSTANTIATE_TEST_SUITE_P(SearchPatterns, BruteForceWithARegion,
                         ::testing::ValuesIn(kSearchPatterns),
                         [](const auto& tested) { return std::string(name_of(tested.param)); });

void expect_identical(const LinkDistances& expected, const LinkDistances& actual) {
  ASSERT_EQ(expected.links.size(), actual.links.size());
  for (std::size_t i = 0; i < expected.links.size(); ++i) {
    ASSERT_EQ(actual.links[i].status, expected.links[i].status);
    EXPECT_EQ(actual.links[i].robot_pixels, expected.links[i].robot_pixels);
    if (expected.links[i].status != LinkStatus::ok) continue;
    EXPECT_EQ(actual.links[i].distance_m, expected.links[i].distance_m);
    EXPECT_EQ(actual.links[i].lower_bound_m, expected.links[i].lower_bound_m);
  }
}

TEST_P(BruteForceWithARegion, GivesTheDistancesThatItGivesWithout) {
  for (const PixelRect size :
       {PixelRect{0, 0, 90, 70}, {0, 0, 33, 17}, {0, 0, 1, 1}, {0, 0, 3, 60}}) {
    for (std::uint32_t seed = 0; seed < thinned(30u); ++seed) {
      SCOPED_TRACE(seed);
      const sim::ImagePair images = sim::random_images(seed, size.u_end, size.v_end, 4);
      for (const double range_m : {0.05, 0.3, 1.0, 30.0}) {
        const LinkDistances found =
            answer(Method::brute_force, images, settings_with(cube(), range_m));
        expect_identical(answer(Method::brute_force, images, range_m), found);
        expect_same_answer(found, found, images);
      }
    }
  }
}

TEST_P(BruteForceWithARegion, HoldsForRangesThatJustReachOrMiss) {
  for (std::uint32_t seed = 0; seed < thinned(30u); ++seed) {
    const sim::ImagePair images = sim::random_images(seed, 60, 45, 3);
    for (const LinkDistance& link : answer(Method::brute_force, images, 3.0).links) {
      if (link.status != LinkStatus::ok || link.distance_m == 0) continue;
      for (const float range_m : {link.distance_m, std::nextafter(link.distance_m, 0.0f)}) {
        expect_identical(answer(Method::brute_force, images, range_m),
                         answer(Method::brute_force, images, settings_with(cube(), range_m)));
      }
    }
  }
}

TEST_P(BruteForceWithARegion, ComputesFewerPairs) {
  const sim::ImagePair images = sim::random_images(5, 160, 120, 4);
  const std::int64_t all = answer(Method::brute_force, images).pairs;
  EXPECT_LT(answer(Method::brute_force, images, settings_with(cube())).pairs, all / 4);
}

/// Nothing is closer than the first pair, so nothing shrinks.
TEST_P(BruteForceWithARegion, CountsTheObstaclePixelsInTheRegion) {
  sim::ImagePair images = sim::empty_images(90, 60, 1);
  put_robot(images, 40, 30, 1.0f);
  put_obstacle(images, {0, 0, 90, 60}, 1.2f);
  put_obstacle(images, {40, 0, 90, 60}, kNoDepth);
  const Camera& camera = images.camera;
  const LinkDistances found = answer(Method::brute_force, images, settings_with(cube(), 0.15));
  EXPECT_EQ(found.links[0].status, LinkStatus::none_in_range);
  EXPECT_EQ(found.pairs, 0) << "too deep for L";

  put_obstacle(images, {0, 0, 40, 60}, 1.1f);
  const double range_m = 0.1001;
  const PixelRect rect = region_of_surveillance(camera, {40, 30}, 1.0f, range_m * (1 + 1e-5));
  const std::int64_t pairs =
      answer(Method::brute_force, images, settings_with(cube(), range_m)).pairs;
  EXPECT_GT(pairs, 0);
  EXPECT_LE(pairs, (40 - rect.u_begin) * (rect.v_end - rect.v_begin));
}

TEST_P(BruteForceWithARegion, ThatDoesNotShrinkGivesTheSameOverMorePairs) {
  SurveillanceSettings whole = cube();
  whole.shrinking = Shrinking::none;
  std::int64_t shrunk_pairs = 0;
  std::int64_t whole_pairs = 0;
  std::int64_t near_pairs = 0;
  for (std::uint32_t seed = 0; seed < 8; ++seed) {
    SCOPED_TRACE(seed);
    const sim::ImagePair images = sim::random_images(seed, 90, 70, 4);
    const LinkDistances shrunk = answer(Method::brute_force, images, settings_with(cube(), 2));
    const LinkDistances kept = answer(Method::brute_force, images, settings_with(whole, 2));
    expect_identical(shrunk, kept);
    shrunk_pairs += shrunk.pairs;
    whole_pairs += kept.pairs;
    near_pairs += answer(Method::brute_force, images, settings_with(whole, 0.5)).pairs;
  }
  EXPECT_GT(whole_pairs, 2 * shrunk_pairs);
  EXPECT_GT(whole_pairs, 2 * near_pairs) << "they grow with L";
  EXPECT_GT(near_pairs, 0);
}

TEST_P(BruteForceWithARegion, TheThesissCubeLosesAnObstacleInFrontOfIt) {
  sim::ImagePair images = sim::empty_images(90, 60, 1);
  put_robot(images, 40, 30, 2.0f);
  put_obstacle(images, {40, 30, 41, 31}, 0.5f);
  put_obstacle(images, {60, 30, 61, 31}, 2.0f);
  const LinkDistance gray =
      answer(Method::brute_force, images, settings_with(cube(DepthInterval::gray_area))).links[0];
  const LinkDistance lost =
      answer(Method::brute_force, images, settings_with(cube(DepthInterval::cube))).links[0];
  EXPECT_EQ(gray.distance_m, 0);
  EXPECT_GT(lost.distance_m, 0.3f);
  EXPECT_EQ(lost.obstacle_pixel, (Pixel{60, 30}));
  EXPECT_EQ(lost.lower_bound_m, 0) << "a distance that may be too large is not certified";
}

TEST_P(BruteForceWithARegion, FlaccosRectangleLosesWhatLiesBesideTheAxis) {
  sim::ImagePair images = sim::empty_images(201, 61, 1);
  images.camera.fx_px = images.camera.fy_px = 60;
  put_robot(images, 180, 30, 1.0f);
  // Towards the axis and deeper: its pixel is far, its point is not.
  put_obstacle(images, {171, 30, 172, 31}, 1.08f);
  const double range_m = 0.1;
  const LinkDistance truth = answer(Method::brute_force, images, range_m).links[0];
  ASSERT_EQ(truth.status, LinkStatus::ok);
  const LinkDistance found =
      answer(Method::brute_force, images,
             settings_with({SurveillanceRegion::flacco, DepthInterval::gray_area, GetParam()},
                           range_m))
          .links[0];
  EXPECT_EQ(found.status, LinkStatus::none_in_range);
  EXPECT_EQ(found.lower_bound_m, 0);
}

TEST_P(BruteForceWithARegion, FlaccosRectangleIsNeverBelowTheTruth) {
  int lost = 0;
  for (std::uint32_t seed = 0; seed < 60; ++seed) {
    const sim::ImagePair images = sim::random_images(seed, 90, 70, 4);
    const LinkDistances truth = answer(Method::brute_force, images);
    const LinkDistances found =
        answer(Method::brute_force, images,
               settings_with({SurveillanceRegion::flacco, DepthInterval::gray_area, GetParam()}));
    expect_possible_answer(truth, found, images);
    for (std::size_t i = 0; i < truth.links.size(); ++i) {
      lost += truth.links[i].status == LinkStatus::ok &&
              !(found.links[i].distance_m <= truth.links[i].distance_m);
    }
  }
  EXPECT_GT(lost, 0);
}

/// The image as region never shrinks, and with a depth interval it is not the plain path.
TEST_P(BruteForceWithARegion, TheImageWithoutIntervalIsTheDefinition) {
  const sim::ImagePair images = sim::random_images(9, 90, 70, 4);
  const LinkDistances plain = answer(Method::brute_force, images);
  const LinkDistances image =
      answer(Method::brute_force, images,
             settings_with({SurveillanceRegion::image, DepthInterval::gray_area, GetParam()}));
  expect_identical(plain, image);
  EXPECT_EQ(image.pairs, plain.pairs);
}

/// A pair that does not count, as close and earlier in its row.
TEST_P(BruteForceWithARegion, TellsThePairThatLiesInTheCube) {
  sim::ImagePair images = sim::empty_images(90, 60, 1);
  put_robot(images, 40, 30, 2.0f);
  put_obstacle(images, {35, 30, 36, 31}, 0.5f);
  put_obstacle(images, {45, 30, 46, 31}, 2.0f);
  const LinkDistance link =
      answer(Method::brute_force, images, settings_with(cube(DepthInterval::cube))).links[0];
  EXPECT_EQ(link.obstacle_pixel, (Pixel{45, 30}));
}

Surveillance surveillance_of(const sim::ImagePair& images, const Metric& metric,
                             DepthView obstacle_m, SearchPattern pattern,
                             Shrinking shrinking = Shrinking::per_link) {
  return berth::surveillance_of(
      {images.camera, images.robot, images.link_count, SearchableDepth(obstacle_m),
       settings_with({.search_pattern = pattern, .shrinking = shrinking}, 0.9)},
      metric, SurveillanceRegion::cube_projection);
}

TEST(SearchAround, ShrinksItsRegionAsItGoes) {
  sim::ImagePair images = sim::empty_images(64, 48, 1);
  const Metric metric = metric_of(images.camera);
  put_obstacle(images, {0, 0, 64, 48}, 1.02f);
  for (const SearchPattern pattern : kSearchPatterns) {
    ClosestPair best = no_pair_within(0.9f);
    const std::int64_t pairs =
        search_around(surveillance_of(images, metric, images.obstacle_depth_m, pattern), {30, 20},
                      1.0f, {1, 1}, best);
    EXPECT_NEAR(best.squared_m2, 0.0004, 1e-5);
    // From the top it needs half of the image.
    EXPECT_LT(pairs, pattern == SearchPattern::row_major ? 64 * 25 : 64 * 4);
  }
}

TEST(SearchAround, WithoutShrinkingSeesAllOfTheRegion) {
  sim::ImagePair images = sim::empty_images(64, 48, 1);
  const Metric metric = metric_of(images.camera);
  put_obstacle(images, {0, 0, 64, 48}, 1.02f);
  put_obstacle(images, {30, 20, 31, 21}, 1.0f);
  const PixelRect region = region_of_surveillance(images.camera, {30, 20}, 4.0f, 0.9 * (1 + 1e-5));
  ASSERT_GT(region.u_begin, 0) << "it is not the whole image";
  for (const SearchPattern pattern : kSearchPatterns) {
    const Surveillance surveillance =
        surveillance_of(images, metric, images.obstacle_depth_m, pattern, Shrinking::none);
    ClosestPair best = no_pair_within(0.9f);
    const std::int64_t all = (region.u_end - region.u_begin) * (region.v_end - region.v_begin);
    EXPECT_EQ(search_around(surveillance, {30, 20}, 4.0f, {1, 1}, best), all);
    EXPECT_EQ(best.squared_m2, 0);
    EXPECT_EQ(search_around(surveillance, {30, 20}, 4.0f, {1, 1}, best), all) << "nor afterwards";
  }
}

TEST(SearchAround, SkipsTheGapsBetweenTheRowsOfAnImage) {
  const sim::ImagePair images = sim::random_images(5, 61, 40, 1);
  const Metric metric = metric_of(images.camera);
  DepthImage wide(80, 40, 0.1f);
  for (int v = 0; v < 40; ++v) std::copy_n(images.obstacle_depth_m.row(v), 61, wide.row(v));
  for (const SearchPattern pattern : kSearchPatterns) {
    for (const Pixel robot : {Pixel{0, 39}, {60, 39}, {30, 20}}) {
      ClosestPair best = no_pair_within(5);
      ClosestPair best_of_wide = best;
      const std::int64_t pairs =
          search_around(surveillance_of(images, metric, images.obstacle_depth_m, pattern), robot,
                        1.0f, {1, 1}, best);
      EXPECT_EQ(search_around(surveillance_of(images, metric, {wide.row(0), 61, 40, 80}, pattern),
                              robot, 1.0f, {1, 1}, best_of_wide),
                pairs);
      EXPECT_EQ(best_of_wide.squared_m2, best.squared_m2);
    }
  }
}

TEST(SearchAround, WithStepsSeesEveryStepthPixelOnly) {
  sim::ImagePair images = sim::empty_images(64, 48, 1);
  const Metric metric = metric_of(images.camera);
  put_obstacle(images, {0, 0, 64, 48}, 1.0f);
  for (const SearchPattern pattern : kSearchPatterns) {
    for (const PixelStep step : {PixelStep{1, 1}, {3, 2}, {7, 7}, {16, 1}}) {
      const Surveillance surveillance = berth::surveillance_of(
          {images.camera, images.robot, images.link_count, SearchableDepth(images.obstacle_depth_m),
           settings_with({.region = SurveillanceRegion::image, .search_pattern = pattern})},
          metric, SurveillanceRegion::cube_projection);
      ClosestPair best{1e-30f};
      // The robot pixel itself has no reading, so that nothing touches it.
      images.obstacle_depth_m(30, 20) = kNoDepth;
      const std::int64_t pairs = search_around(surveillance, {30, 20}, 1.5f, step, best);
      const std::int64_t columns = 30 / step.x + 1 + 33 / step.x;
      const std::int64_t rows = 20 / step.y + 1 + 27 / step.y;
      if (step.x == 1 || step.y == 1) {
        EXPECT_EQ(best.squared_m2, 0) << "its neighbours touch it";
      } else {
        EXPECT_EQ(pairs, columns * rows - 1);
      }
    }
  }
}

}  // namespace
}  // namespace berth::testing
