// A program of its own, because allocation_count replaces the global operator new.
#include "tests/image_distance/answer.hpp"
#include "tests/support/allocation_count.hpp"

namespace berth::testing {
namespace {

class SteadyState : public ::testing::TestWithParam<Method> {};
INSTANTIATE_TEST_SUITE_P(Methods, SteadyState, ::testing::Values(Method::exact, Method::lattice),
                         method_test_name);

TEST_P(SteadyState, NothingIsAllocatedOnceTheSceneWasSeen) {
  const sim::ImagePair images[] = {sim::random_images(1, 160, 120, 8),
                                   sim::random_images(2, 160, 120, 8)};
  SearchableDepth obstacles;
  EvaluateWorkspace workspace;
  LinkDistances out;
  const auto answer_both = [&] {
    for (const sim::ImagePair& pair : images) {
      obstacles.build(pair.obstacle_depth_m);
      evaluate(GetParam(), {pair.camera, pair.robot, 8, obstacles, image_settings(1.0, true)},
               workspace, out);
    }
  };
  answer_both();
  const std::size_t before = allocation_count();
  answer_both();
  EXPECT_EQ(allocation_count(), before);
  EXPECT_GT(before, 0u);
}

}  // namespace
}  // namespace berth::testing
