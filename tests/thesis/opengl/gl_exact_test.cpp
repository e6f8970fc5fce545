// What the tests of all methods (tests/distance) do not ask of gl_exact.
#include <thread>

#include "tests/support/gl_test.hpp"
#include "tests/thesis/answer.hpp"

namespace berth::testing {
namespace {

class GlExactTest : public GlTest {};

TEST_F(GlExactTest, MeanDirectionsAreThoseOfTheCpu) {
  int compared = 0;
  for (std::uint32_t seed = 0; seed < 12; ++seed) {
    SCOPED_TRACE(seed);
    const sim::ImagePair images = sim::random_images(seed, 160, 120, 5);
    for (const double range_m : {0.2, 1.0}) {
      const LinkDistances expected = answer(Method::exact, images, image_settings(range_m, true));
      const LinkDistances found = answer(Method::gl_exact, images, image_settings(range_m, true));
      for (std::size_t i = 0; i < found.links.size(); ++i) {
        const LinkDistance& a = expected.links[i];
        const LinkDistance& b = found.links[i];
        // Of several pairs at the same distance each may take another one.
        if (a.status != LinkStatus::ok || a.robot_pixel != b.robot_pixel) continue;
        ++compared;
        EXPECT_EQ(a.mean_count, b.mean_count);
        if (a.mean_count == 0) continue;
        EXPECT_LT((a.mean_direction_C - b.mean_direction_C).norm(), kMeanDirectionError);
      }
    }
  }
  EXPECT_GT(compared, 40);
}

TEST_F(GlExactTest, WithoutMeanDirectionsThereAreNone) {
  const LinkDistances found =
      answer(Method::gl_exact, sim::random_images(1, 90, 70, 3), image_settings(1.0, false));
  for (const LinkDistance& link : found.links) {
    EXPECT_TRUE(link.mean_direction_C.array().isNaN().all());
    EXPECT_EQ(link.mean_count, 0);
  }
}

TEST_F(GlExactTest, TheSameImagesGiveTheSamePairsAgain) {
  const sim::ImagePair images = sim::random_images(3, 200, 150, 8);
  const LinkDistances first = answer(Method::gl_exact, images);
  for (int i = 0; i < 5; ++i) {
    const LinkDistances again = answer(Method::gl_exact, images);
    for (std::size_t k = 0; k < first.links.size(); ++k) {
      EXPECT_EQ(first.links[k].robot_pixel, again.links[k].robot_pixel);
      EXPECT_EQ(first.links[k].obstacle_pixel, again.links[k].obstacle_pixel);
    }
  }
}

TEST_F(GlExactTest, ItTriesFewerPairsThanThereAre) {
  const sim::ImagePair images = sim::random_images(4, 240, 180, 8);
  const std::int64_t all = answer(Method::brute_force, images).pairs;
  const std::int64_t tried = answer(Method::gl_exact, images).pairs;
  EXPECT_GT(tried, 0);
  EXPECT_LT(tried, all / 10);
}

TEST_F(GlExactTest, AMethodOfTheCpuIsRefused) {
  const sim::ImagePair images = sim::empty_images(8, 8, 1);
  LinkDistances out;
  const SearchableDepth obstacles(images.obstacle_depth_m);
  const ImageDistanceSettings settings;
  const ImageRequest request{images.camera, images.robot, 1, obstacles, settings};
  EXPECT_THROW(shared_gl()->evaluator.evaluate(Method::exact, request, out), std::invalid_argument);
}

TEST_F(GlExactTest, TwoContextsInTwoThreadsGiveTheirOwnAnswers) {
  const auto ask = [](std::uint32_t first_seed, std::string* error) {
    try {
      GlContext own;
      GlEvaluator evaluator;
      LinkDistances found;
      for (std::uint32_t seed = first_seed; seed < first_seed + 6; ++seed) {
        const sim::ImagePair images = sim::random_images(seed, 100, 80, 4);
        evaluator.evaluate(Method::gl_exact,
                           {images.camera, images.robot, images.link_count,
                            SearchableDepth(images.obstacle_depth_m), image_settings(1.0, false)},
                           found);
        const LinkDistances truth = answer(Method::brute_force, images);
        for (std::size_t i = 0; i < truth.links.size(); ++i) {
          if (truth.links[i].status != found.links[i].status) *error = "status";
          if (truth.links[i].status != LinkStatus::ok) continue;
          const float difference_m = truth.links[i].distance_m - found.links[i].distance_m;
          if (std::abs(difference_m) > 2e-5f) *error = "distance";
        }
      }
      own.check("a thread");
    } catch (const std::exception& thrown) {
      *error = thrown.what();
    }
  };
  std::string errors[2];
  std::thread one(ask, 10, &errors[0]);
  std::thread two(ask, 50, &errors[1]);
  one.join();
  two.join();
  EXPECT_EQ(errors[0], "");
  EXPECT_EQ(errors[1], "");
}

}  // namespace
}  // namespace berth::testing
