// A program of its own, because allocation_count replaces the global operator new.
#include <tbb/global_control.h>

#include "berth/pipeline/observer.hpp"
#include "berth/scene/open_scene.hpp"
#include "tests/support/allocation_count.hpp"
#include "tests/thesis/answer.hpp"
#include "thesis/image_query.hpp"

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

/// From frames of the bundled scene, at the joints of the exposure and at others.
TEST(ImageQuerySteadyState, NothingIsAllocatedOnceTheFramesWereSeen) {
  const OpenScene scene = open_scene(BERTH_SOURCE_DIR "/data/bundled/one_camera.yaml");
  const OpenCamera& camera = scene.cameras.front();
  Frame frames[2];
  for (std::size_t i = 0; i < 2; ++i) {
    Observer(camera.mounted)
        .observe(camera.read_depth(9 * i), camera.at_exposure[9 * i], frames[i]);
  }
  const tbb::global_control one_thread(tbb::global_control::max_allowed_parallelism, 1);
  ImageQuery query(scene.robot, Method::exact);
  const auto go_through = [&] {
    for (const Frame& frame : frames) {
      query.ask(frame);
      query.ask(frame, camera.at_exposure[20]);
      query.ask(frame, {}, frame.stamp_s + 10);
    }
  };
  go_through();
  go_through();
  const std::size_t before = allocation_count();
  for (int round = 0; round < 20; ++round) go_through();
  EXPECT_EQ(allocation_count(), before);
}

}  // namespace
}  // namespace berth::testing
