// What the thesis's evaluators on OpenGL promise, and how far they may be trusted.
#include <cmath>
#include <cstdio>

#include "tests/thesis/answer.hpp"
#include "tests/thesis/close_share.hpp"
#include "tests/thesis/plain_gl_lattice.hpp"

namespace berth::testing {
namespace {

class GlLattices : public MethodTest {
 protected:
  LinkDistances found(const sim::ImagePair& images, const LatticeSettings& lattice = {}) const {
    ImageDistanceSettings settings;
    settings.mean_direction = false;
    settings.lattice = lattice;
    return answer(GetParam(), images, settings);
  }
  std::int64_t pairs(const LatticeSettings& lattice) const {
    std::int64_t sum = 0;
    for (std::uint32_t seed = 0; seed < 3; ++seed) {
      sum += found(sim::random_images(seed, 128, 96, 4), lattice).pairs;
    }
    return sum;
  }
};
INSTANTIATE_TEST_SUITE_P(Methods, GlLattices,
                         ::testing::Values(Method::gl_lattice, Method::gl_hybrid),
                         method_test_name);
class OnlyGlLattice : public GlLattices {};
INSTANTIATE_TEST_SUITE_P(Methods, OnlyGlLattice, ::testing::Values(Method::gl_lattice),
                         method_test_name);
class OnlyGlHybrid : public GlLattices {};
INSTANTIATE_TEST_SUITE_P(Methods, OnlyGlHybrid, ::testing::Values(Method::gl_hybrid),
                         method_test_name);

const LatticeSettings kGlLattices[] = {
    {1, 1, 40, 2, 16}, {2, 3, 60, 1, 64}, {4, 4, 5, 3, 5}, {65536, 1, 7, 7, 16}, {1, 8, 30, 30, 1}};

void expect_same_pixels(const LinkDistances& expected, const LinkDistances& actual) {
  ASSERT_EQ(actual.links.size(), expected.links.size());
  for (std::size_t i = 0; i < expected.links.size(); ++i) {
    SCOPED_TRACE("link " + std::to_string(i + 1));
    EXPECT_EQ(actual.links[i].status, expected.links[i].status);
    EXPECT_EQ(actual.links[i].robot_pixels, expected.links[i].robot_pixels);
    EXPECT_EQ(actual.links[i].robot_pixel, expected.links[i].robot_pixel);
    EXPECT_EQ(actual.links[i].obstacle_pixel, expected.links[i].obstacle_pixel);
  }
}

TEST_P(OnlyGlLattice, FindsThePixelsOfItsSlowTwinFromAsManyPairs) {
  for (const auto& [width, height, links] : {std::tuple{97, 131, 5}, {1, 1, 1}, {33, 17, 64}}) {
    for (std::uint32_t seed = 0; seed < 3; ++seed) {
      const sim::ImagePair images = sim::random_images(seed, width, height, links);
      for (const LatticeSettings& lattice : kGlLattices) {
        SCOPED_TRACE(std::to_string(width) + " wide, seed " + std::to_string(seed) + ", tile " +
                     std::to_string(lattice.tile_px));
        ImageDistanceSettings settings;
        settings.lattice = lattice;
        const LinkDistances expected = plain_gl_lattice(images, settings);
        const LinkDistances actual = found(images, lattice);
        expect_same_pixels(expected, actual);
        EXPECT_EQ(actual.pairs, expected.pairs);
      }
    }
  }
}

TEST_P(OnlyGlHybrid, FindsThePixelsOfLatticeInTheWholeImage) {
  for (std::uint32_t seed = 0; seed < 3; ++seed) {
    SCOPED_TRACE(seed);
    const sim::ImagePair images = sim::random_images(seed, 131, 97, 5);
    for (const LatticeSettings& lattice : kGlLattices) {
      ImageDistanceSettings settings;
      settings.mean_direction = false;
      settings.lattice = lattice;
      settings.surveillance.region = SurveillanceRegion::image;
      const LinkDistances expected = answer(Method::lattice, images, settings);
      const LinkDistances actual = found(images, lattice);
      expect_same_pixels(expected, actual);
      // The CPU passes over depths beyond the closest pair so far.
      EXPECT_GE(actual.pairs, expected.pairs);
    }
  }
}

TEST_P(GlLattices, AreNeverBelowBruteForceWhateverTheirSettings) {
  for (std::uint32_t seed = 0; seed < 2; ++seed) {
    SCOPED_TRACE(seed);
    const sim::ImagePair images = sim::random_images(seed, 131, 97, 5);
    const LinkDistances truth = answer(Method::brute_force, images);
    for (const LatticeSettings& lattice : kGlLattices) {
      expect_possible_answer(truth, found(images, lattice), images);
    }
  }
}

TEST_P(GlLattices, AreExactWhereTheLastStepHasAllPixelsOfTheLink) {
  for (std::uint32_t seed = 0; seed < 6; ++seed) {
    SCOPED_TRACE(seed);
    const sim::ImagePair images = sim::random_images(seed, 60, 44, 3);
    ImageDistanceSettings settings;
    settings.range_m = 50;
    settings.mean_direction = false;
    settings.lattice = {1, 1, 200, 200, 16};
    expect_same_answer(answer(Method::brute_force, images, 50),
                       answer(GetParam(), images, settings), images);
  }
}

TEST_P(GlLattices, AreExactForLinksOfOnePixel) {
  for (std::uint32_t seed = 0; seed < 10; ++seed) {
    SCOPED_TRACE(seed);
    sim::ImagePair images = sim::random_images(seed, 80, 60, 1);
    images.robot = sim::empty_images(80, 60, 1).robot;
    images.link_count = 6;
    for (int i = 0; i < 6; ++i) {
      put_robot(images, (i * 31 + static_cast<int>(seed)) % 80, (i * 17) % 60,
                0.4f + 0.3f * static_cast<float>(i), static_cast<LinkId>(i + 1));
    }
    expect_same_answer(answer(Method::brute_force, images), found(images), images);
  }
}

/// A bar with an obstacle beside its end: refinement has to walk there.
TEST_P(GlLattices, FindTheEndOfALongLink) {
  sim::ImagePair images = sim::empty_images(640, 240, 1);
  for (int u = 50; u < 500; ++u) {
    for (int v = 100; v < 130; ++v) put_robot(images, u, v, 1.0f);
  }
  put_obstacle(images, {520, 90, 540, 140}, 1.0f);
  const LinkDistance link = found(images).links[0];
  EXPECT_EQ(link.robot_pixel.u, 499);
  EXPECT_FLOAT_EQ(link.distance_m, static_cast<float>(20 / images.camera.fx_px));
}

TEST_P(GlLattices, TheLastStepPassesOverNoObstaclePixel) {
  sim::ImagePair images = sim::empty_images(200, 100, 1);
  put_robot(images, 100, 50, 1.0f);
  put_obstacle(images, {113, 43, 140, 49}, 1.0f);
  EXPECT_EQ(found(images, {4, 5, 40, 2}).links[0].obstacle_pixel, (Pixel{113, 48}));
}

/// Why steps are dangerous, and the default is 1.
TEST_P(GlLattices, StepsPassOverAThinObstacleAndCertifyNothing) {
  sim::ImagePair images = sim::empty_images(200, 100, 1);
  put_robot(images, 100, 50, 1.0f);
  put_obstacle(images, {117, 0, 118, 100}, 1.0f);
  EXPECT_EQ(found(images, {1, 4, 40, 2}).links[0].status, LinkStatus::ok);
  const LinkDistance link = found(images, {4, 1, 40, 2}).links[0];
  EXPECT_EQ(link.status, LinkStatus::none_in_range);
  EXPECT_EQ(link.lower_bound_m, 0);
}

/// At the thesis's size: in smaller images 5 mm are less than a step.
TEST_P(GlLattices, AreWithin5MillimetresForNineOfTenLinksWithStepsOf2) {
  CloseShare share;
  for (std::uint32_t seed = 0; seed < 4; ++seed) {
    const sim::ImagePair images = sim::random_images(seed, 640, 480, 8);
    share.add(answer(Method::exact, images), found(images, {2, 2, 10, 2, 16}));
  }
  std::printf("%d of %d links within 5 mm\n", share.close, share.links);
  EXPECT_GT(share.links, 25);
  EXPECT_GE(share.close, 0.9 * share.links);
}

TEST_P(GlLattices, LargerStepsComputeFewerPairs) {
  const std::int64_t without = pairs({1, 1, 40, 2, 16});
  EXPECT_LT(pairs({2, 1, 40, 2, 16}), without);
  EXPECT_LT(pairs({1, 2, 40, 2, 16}), without);
  EXPECT_LT(pairs({4, 4, 40, 2, 16}), pairs({2, 2, 40, 2, 16}));
}

TEST_P(GlLattices, ALargerFinalRadiusComputesMorePairs) {
  EXPECT_GT(pairs({1, 1, 40, 8, 16}), pairs({1, 1, 40, 4, 16}));
}

TEST_P(OnlyGlLattice, SmallerTilesComputeMorePairs) {
  EXPECT_GT(pairs({1, 1, 40, 2, 5}), pairs({1, 1, 40, 2, 16}));
  EXPECT_EQ(pairs({1, 1, 20, 2, 16}), pairs({1, 1, 40, 2, 16}));
}

TEST_P(OnlyGlHybrid, ASmallerFirstRadiusComputesMorePairs) {
  EXPECT_GT(pairs({1, 1, 5, 2, 16}), pairs({1, 1, 10, 2, 16}));
  EXPECT_EQ(pairs({1, 1, 10, 2, 5}), pairs({1, 1, 10, 2, 16}));
}

}  // namespace
}  // namespace berth::testing
