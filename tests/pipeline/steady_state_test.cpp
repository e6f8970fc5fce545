// A program of its own, because allocation_count replaces the global operator new.
#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include "berth/pipeline/configuration_check.hpp"
#include "berth/pipeline/frame_set.hpp"
#include "berth/pipeline/observer.hpp"
#include "berth/pipeline/prepared_space.hpp"
#include "berth/pipeline/query.hpp"
#include "berth/scene/open_scene.hpp"
#include "tests/pipeline/flying_pixels.hpp"
#include "tests/support/allocation_count.hpp"
#include "tests/support/mounted_with.hpp"

namespace berth {
namespace {

/// From the depth image to the result, and the result at other joint angles.
TEST(SteadyState, TheWholeWayAllocatesNothingOnceItHasSeenTheImages) {
  const OpenScene scene = open_scene(BERTH_SOURCE_DIR "/data/bundled/one_camera.yaml");
  const OpenCamera& camera = scene.cameras.front();
  DepthImage images[] = {camera.read_depth(3), camera.read_depth(17), camera.read_depth(30)};
  const std::size_t numbers[] = {3, 17, 30};
  CameraSettings with_region = camera.mounted->settings();
  with_region.self_filter.robot_region_scale = 3;
  const auto region_view = testing::mounted_with(*camera.mounted, with_region);
  for (const int threads : {1, 2}) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    Observer observer(camera.mounted);
    Query query(scene.robot);
    Observer region_observer(region_view);
    Frame frame;
    observer.observe(images[0], camera.at_exposure[numbers[0]], frame);
    draw_flying_pixels(frame.robot, images[0]);
    const auto go_through = [&] {
      for (int i = 0; i < 3; ++i) {
        region_observer.observe(images[i], camera.at_exposure[numbers[i]], frame);
        observer.observe(images[i], camera.at_exposure[numbers[i]], frame);
        EXPECT_EQ(frame.obstacles.count_of(PixelFate::flying_patch) > 0, i == 0);
        query.ask({frame});
        for (const std::size_t other : numbers) {
          query.ask({frame, camera.at_exposure[other]});
        }
      }
    };
    // The second time begins with what the first one found.
    go_through();
    go_through();
    const std::size_t before = allocation_count();
    for (int round = 0; round < 20; ++round) go_through();
    EXPECT_EQ(allocation_count(), before) << threads << " threads";
  }
}

/// What frames left of space is kept while they are the same.
TEST(SteadyState, TheSameFramesAskedAgainAreNotAssembledAnew) {
  const OpenScene scene = open_scene(BERTH_SOURCE_DIR "/data/bundled/scene.yaml");
  std::vector<Frame> observed(scene.cameras.size());
  std::vector<const Frame*> frames;
  for (std::size_t c = 0; c < observed.size(); ++c) {
    const OpenCamera& camera = scene.cameras[c];
    Observer(camera.mounted).observe(camera.read_depth(0), camera.at_exposure[0], observed[c]);
    frames.push_back(&observed[c]);
  }
  const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, 1);
  Query query(scene.robot);
  query.ask({frames});
  query.ask({frames});
  const std::uint64_t assembled = query.frames().space().serial_number();
  const std::size_t before = allocation_count();
  for (int round = 0; round < 20; ++round) query.ask({frames});
  EXPECT_EQ(allocation_count(), before);
  EXPECT_EQ(query.frames().space().serial_number(), assembled);
  const OpenCamera& camera = scene.cameras[0];
  Observer(camera.mounted).observe(camera.read_depth(1), camera.at_exposure[1], observed[0]);
  query.ask({frames});
  EXPECT_NE(query.frames().space().serial_number(), assembled);
}

TEST(SteadyState, ManyConfigurationsAreAskedAboutWithoutAnAllocation) {
  const OpenScene scene = open_scene(BERTH_SOURCE_DIR "/data/bundled/one_camera.yaml");
  const OpenCamera& camera = scene.cameras.front();
  Frame frame;
  Observer(camera.mounted).observe(camera.read_depth(0), camera.at_exposure[0], frame);
  const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, 1);
  ConfigurationCheck check(scene.robot);
  check.prepare(frame);
  std::vector<double> positions, to;
  for (const JointState& joints : camera.at_exposure) {
    positions.insert(positions.end(), joints.position.begin(), joints.position.end());
  }
  for (const double position : positions) to.push_back(position + 0.1);
  std::vector<Verdict> verdicts(camera.at_exposure.size());
  const ConfigurationMargins margins{.known_margin_m = 0.01};
  const auto ask = [&] {
    check.ask(positions, margins, verdicts);
    check.ask_motions(positions, to, margins, verdicts);
  };
  ask();
  ask();
  const std::size_t before = allocation_count();
  for (int round = 0; round < 20; ++round) ask();
  EXPECT_EQ(allocation_count(), before);
}

/// Spaces of cameras out of step, made ready one after the other, and requests that go on from
/// them.
TEST(SteadyState, PreparedSpacesAllocateNothingOnceTheyHaveSeenTheFrames) {
  const OpenScene scene = open_scene(BERTH_SOURCE_DIR "/data/bundled/scene.yaml");
  std::vector<std::vector<std::shared_ptr<const Frame>>> sets;
  for (const std::size_t i : {3, 4, 5}) {
    std::vector<std::shared_ptr<const Frame>>& set = sets.emplace_back();
    for (const OpenCamera& camera : scene.cameras) {
      auto frame = std::make_shared<Frame>();
      Observer(camera.mounted).observe(camera.read_depth(i), camera.at_exposure[i], *frame);
      set.push_back(std::move(frame));
    }
  }
  const std::vector<JointState>& joints = scene.cameras[0].at_exposure;
  const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, 1);
  std::vector<std::shared_ptr<PreparedSpace>> spaces;
  for (int i = 0; i < 2; ++i) spaces.push_back(std::make_shared<PreparedSpace>(scene.robot, 3));
  Query query(scene.robot);
  // Two spaces and three sets take turns, so that each space has them all.
  const auto go_through = [&] {
    for (std::size_t i = 0; i < 6; ++i) {
      spaces[i % 2]->prepare(sets[i % 3], &joints[i]);
      for (std::size_t of = i; of < i + 4; ++of) {
        query.ask({.frames = {spaces[i % 2]}, .joints = joints[of]});
      }
    }
  };
  for (int round = 0; round < 3; ++round) go_through();
  const std::size_t before = allocation_count();
  for (int round = 0; round < 5; ++round) go_through();
  EXPECT_EQ(allocation_count(), before);
}

/// Joints pushed and looked up, frames that are refused, results that are withheld.
TEST(SteadyState, TheRunningRobotsWayAllocatesNothingOnceItsBufferIsFull) {
  const OpenScene scene = open_scene(BERTH_SOURCE_DIR "/data/bundled/one_camera.yaml");
  const OpenCamera& camera = scene.cameras.front();
  const DepthImage depth_m = camera.read_depth(3);
  std::vector<std::string> names;
  for (const MovableJoint& joint : camera.mounted->robot()->model().joints)
    names.push_back(joint.name);
  JointBuffer joints(camera.mounted->robot()->model(), 50);
  Observer observer(camera.mounted);
  Query query(scene.robot);
  Frame frame;
  int ms = 0;
  const auto run_100_ms = [&] {
    for (const int end_ms = ms + 100; ms < end_ms; ++ms) {
      joints.push(1e-3 * ms, names, camera.at_exposure[3 + ms % 3].position);
    }
    const double exposure_s = 1e-3 * (ms - 10);
    observer.observe(depth_m, exposure_s, joints, frame);
    EXPECT_EQ(frame.time.status, TimeStatus::ok);
    const double now_s = 1e-3 * ms;
    EXPECT_EQ(query.ask({frame, joints, now_s}).time.status, TimeStatus::ok);
    EXPECT_EQ(query.ask({frame, {}, now_s + 1}).time.status, TimeStatus::stale_frame);
    observer.observe(depth_m, exposure_s, joints, frame);
    EXPECT_EQ(query.ask({frame}).time.status, TimeStatus::stamp_went_back);
  };
  for (int round = 0; round < 3; ++round) run_100_ms();
  const std::size_t before = allocation_count();
  for (int round = 0; round < 20; ++round) run_100_ms();
  EXPECT_EQ(allocation_count(), before);
}

}  // namespace
}  // namespace berth
