// Every instruction set that this machine has computes the same bits.
#include <bit>

#include "tests/support/only_target.hpp"
#include "tests/support/thinned.hpp"
#include "tests/thesis/answer.hpp"

namespace berth::testing {
namespace {

class InstructionSets : public ::testing::TestWithParam<Method> {};
INSTANTIATE_TEST_SUITE_P(Methods, InstructionSets, ::testing::ValuesIn(kCpuMethods),
                         method_test_name);

TEST_P(InstructionSets, GiveTheSameDistances) {
  for (std::uint32_t seed = 0; seed < thinned(10u); ++seed) {
    const sim::ImagePair images = sim::random_images(seed, 90, 70, 4);
    const LinkDistances best = answer(GetParam(), images);
    on_every_target([&](const char* target) {
      SCOPED_TRACE(target);
      const LinkDistances found = answer(GetParam(), images);
      for (std::size_t i = 0; i < best.links.size(); ++i) {
        ASSERT_EQ(found.links[i].status, best.links[i].status);
        EXPECT_EQ(std::bit_cast<std::uint32_t>(found.links[i].distance_m),
                  std::bit_cast<std::uint32_t>(best.links[i].distance_m));
      }
    });
  }
}

/// Even where the order of the search decides what is found.
TEST(InstructionSetsOfASearch, SearchTheSamePairsAroundARobotPixel) {
  const sim::ImagePair images = sim::random_images(3, 131, 70, 4);
  for (const Method method : {Method::brute_force, Method::lattice}) {
    for (const SearchPattern pattern : kSearchPatterns) {
      ImageDistanceSettings settings;
      settings.mean_direction = false;
      settings.surveillance = {SurveillanceRegion::flacco, DepthInterval::cube, pattern};
      settings.lattice.step_x = 3;
      const LinkDistances best = answer(method, images, settings);
      on_every_target([&](const char* target) {
        SCOPED_TRACE(target);
        const LinkDistances found = answer(method, images, settings);
        EXPECT_EQ(found.pairs, best.pairs);
        for (std::size_t i = 0; i < best.links.size(); ++i) {
          EXPECT_EQ(found.links[i].robot_pixel, best.links[i].robot_pixel);
          EXPECT_EQ(found.links[i].obstacle_pixel, best.links[i].obstacle_pixel);
        }
      });
    }
  }
}

}  // namespace
}  // namespace berth::testing
