// Frames of running cameras, made ready in a thread of their own while requests go on.
#include "berth/live/live_space.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <future>
#include <latch>

#include "berth/live/live_camera.hpp"
#include "berth/pipeline/observer.hpp"
#include "berth/pipeline/query.hpp"
#include "tests/live/live_scene.hpp"
#include "tests/support/error_message.hpp"

namespace berth {
namespace {

using SharedFrame = std::shared_ptr<const Frame>;

class LiveSpaceScene : public ::testing::Test {
 protected:
  LiveSpaceScene() : scene_(open_scene(BERTH_SOURCE_DIR "/data/bundled/scene.yaml")) {
    push_joints(scene_, -1, 10, joints_);
  }

  const std::shared_ptr<const Robot>& robot() const { return scene_.robot; }
  std::shared_ptr<Frame> observe(std::size_t k, std::size_t i, FrameTime time = {}) const {
    const OpenCamera& camera = scene_.cameras[k];
    auto frame = std::make_shared<Frame>();
    Observer(camera.mounted).observe(camera.read_depth(i), camera.at_exposure[i], *frame, time);
    return frame;
  }
  static bool knows(const LiveSpace& space, std::size_t k, const SharedFrame& frame) {
    return comes_true([&] { return space.newest()->frames()[k] == frame; });
  }
  static bool has_prepared(const LiveSpace& space, std::int64_t sets) {
    return comes_true([&] { return space.counts().prepared >= sets; });
  }
  /// Both are right within the default tolerance.
  static void expect_same(const Result& a, const Result& b) {
    EXPECT_EQ(a.status, b.status);
    ASSERT_EQ(a.links.size(), b.links.size());
    for (std::size_t i = 0; i < a.links.size(); ++i) {
      EXPECT_EQ(a.links[i].status, b.links[i].status);
      if (!b.links[i].has_distance()) continue;
      EXPECT_NEAR(a.links[i].distance_m, b.links[i].distance_m, 0.00101);
    }
  }

  OpenScene scene_;
  JointIntake joints_{scene_.robot->model(), {}};
};

TEST_F(LiveSpaceScene, AFrameThatNothingCanBeMadeOfIsCountedAndTheNextGoesOn) {
  LiveSpace space(robot(), 3, joints_);
  const auto nowhere = observe(0, 3);
  nowhere->X_BC = unset_pose();
  space.put(0, nowhere);
  ASSERT_TRUE(comes_true([&] { return space.counts().failed == 1; }));
  const SharedFrame frame = observe(0, 4);
  space.put(0, frame);
  EXPECT_TRUE(knows(space, 0, frame));
}

TEST_F(LiveSpaceScene, TheNewestIsNeverNullAndSoonKnowsWhatWasPut) {
  LiveSpace space(robot(), 3, joints_);
  Query query(robot());
  ASSERT_NE(space.newest(), nullptr);
  EXPECT_EQ(query.ask({.frames = space.newest()}).time.status, TimeStatus::no_frame);
  EXPECT_EQ(query.ask({.frames = space.newest()}).cameras.size(), 3U);
  EXPECT_EQ(space.counts().prepared, 0);
  std::vector<SharedFrame> frames;
  for (std::size_t k = 0; k < 3; ++k) {
    frames.push_back(observe(k, 3));
    space.put(k, frames[k]);
    ASSERT_TRUE(knows(space, k, frames[k]));
    const Result& result = query.ask({.frames = space.newest()});
    EXPECT_EQ(result.status, k < 2 ? ResultStatus::degraded : ResultStatus::ok);
    for (std::size_t i = 0; i < 3; ++i) {
      EXPECT_EQ(result.cameras[i].status, i <= k ? CameraStatus::ok : CameraStatus::no_frame);
    }
  }
  const LiveSpaceCounts counts = space.counts();
  EXPECT_EQ(counts.prepared, 3);
  EXPECT_GT(counts.last_prepare_s, 0);
  EXPECT_GE(counts.most_prepare_s, counts.last_prepare_s);
  Query plain(robot());
  expect_same(query.ask({.frames = space.newest()}), plain.ask({.frames = frames}));
}

TEST_F(LiveSpaceScene, AnyThreadsPutFramesWhileOthersAsk) {
  constexpr int kRounds = 12;
  LiveSpace space(robot(), 3, joints_);
  std::vector<std::vector<SharedFrame>> frames(3);
  for (std::size_t k = 0; k < 3; ++k) {
    for (std::size_t i = 0; i < 3; ++i) frames[k].push_back(observe(k, i));
  }
  std::atomic<int> answers = 0;
  {
    std::vector<std::jthread> asking;
    for (int t = 0; t < 2; ++t) {
      asking.emplace_back([&](const std::stop_token& stop) {
        Query query(robot());
        while (!stop.stop_requested()) {
          const auto newest = space.newest();
          ASSERT_NE(newest, nullptr);
          answers += query.ask({.frames = newest}).time.status == TimeStatus::ok;
        }
      });
    }
    {
      std::vector<std::jthread> putting;
      for (std::size_t k = 0; k < 3; ++k) {
        putting.emplace_back([&, k] {
          for (int round = 0; round < kRounds; ++round) {
            space.put(k, frames[k][round % 3]);
            std::this_thread::sleep_for(std::chrono::milliseconds(2));
          }
        });
      }
    }
    for (std::size_t k = 0; k < 3; ++k) EXPECT_TRUE(knows(space, k, frames[k][(kRounds - 1) % 3]));
    EXPECT_TRUE(comes_true([&] { return answers > 0; }));
  }
  EXPECT_GE(space.counts().prepared, 1);
  EXPECT_LE(space.counts().prepared, 3 * kRounds);
  Query query(robot()), plain(robot());
  const std::vector<SharedFrame> last = {frames[0][2], frames[1][2], frames[2][2]};
  expect_same(query.ask({.frames = space.newest()}), plain.ask({.frames = last}));
}

/// A frame whose last holder waits in its release: so the space's thread is held up at work.
struct HeldUp {
  std::latch reached{1};
  std::latch may_go_on{1};

  SharedFrame hold(SharedFrame frame) {
    const Frame* const at = frame.get();
    return {at, [this, frame = std::move(frame)](const Frame*) {
              reached.count_down();
              may_go_on.wait();
            }};
  }
};

TEST_F(LiveSpaceScene, NobodyWaitsWhileASpaceIsPrepared) {
  HeldUp held;
  LiveSpace space(robot(), 2, joints_);
  const SharedFrame frames[] = {observe(0, 3), observe(0, 4), observe(0, 5)};
  space.put(0, held.hold(frames[0]));
  ASSERT_TRUE(has_prepared(space, 1));
  space.put(0, frames[1]);
  ASSERT_TRUE(has_prepared(space, 2));
  // The memory of the first set is used for the third: what it held is released.
  space.put(0, frames[2]);
  ASSERT_TRUE(comes_true([&] { return held.reached.try_wait(); }));
  const SharedFrame others[] = {observe(1, 3), observe(1, 4)};
  auto asking = std::async(std::launch::async, [&] {
    Query query(robot());
    const bool is_ok = query.ask({.frames = space.newest()}).time.status == TimeStatus::ok;
    for (const SharedFrame& other : others) space.put(1, other);
    return is_ok && space.newest()->frames()[0] == frames[1] && space.counts().prepared == 2;
  });
  const bool came = asking.wait_for(std::chrono::seconds(20)) == std::future_status::ready;
  held.may_go_on.count_down();
  EXPECT_TRUE(came) << "asking and putting waited for the space's thread";
  EXPECT_TRUE(asking.get());
  ASSERT_TRUE(knows(space, 1, others[1]));
  EXPECT_EQ(space.counts().prepared, 4) << "what came meanwhile is made ready together";
}

TEST_F(LiveSpaceScene, ItEndsWhileItWorksAndLeavesWhatIsHeld) {
  const SharedFrame frame = observe(0, 3);
  std::shared_ptr<const PreparedSpace> newest;
  for (int i = 0; i < 10; ++i) {
    LiveSpace space(robot(), 3, joints_);
    for (std::size_t k = 0; k < 3; ++k) space.put(k, k == 0 ? frame : nullptr);
    if (i == 9) {
      ASSERT_TRUE(knows(space, 0, frame));
    }
    newest = space.newest();
  }
  Query query(robot()), plain(robot());
  const std::vector<SharedFrame> frames = {frame, nullptr, nullptr};
  expect_same(query.ask({.frames = newest}), plain.ask({.frames = frames}));
}

TEST_F(LiveSpaceScene, ItMayEndInTheTurnOfACamera) {
  auto space = std::make_unique<LiveSpace>(robot(), 1, joints_);
  const SharedFrame frame = observe(0, 3);
  std::atomic<bool> has_ended = false;
  LiveCamera camera(scene_.cameras[0].mounted, joints_, {.max_wait_s = 30}, [&](const auto&...) {
    space->put(0, frame);
    // Its thread has to wait for a turn.
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
    space.reset();
    has_ended = true;
  });
  camera.push(scene_.cameras[0].source.stamps_s[0], scene_.cameras[0].read_depth(0));
  EXPECT_TRUE(comes_true([&] { return has_ended.load(); }));
}

TEST_F(LiveSpaceScene, OldFramesGoBack) {
  LiveSpace space(robot(), 1, joints_);
  std::weak_ptr<const Frame> first;
  {
    const SharedFrame frame = observe(0, 3);
    first = frame;
    space.put(0, frame);
    ASSERT_TRUE(knows(space, 0, frame));
  }
  for (int i = 0; i < 3; ++i) {
    const SharedFrame frame = observe(0, 4);
    space.put(0, frame);
    ASSERT_TRUE(knows(space, 0, frame));
  }
  EXPECT_TRUE(comes_true([&] { return first.expired(); }));
}

TEST_F(LiveSpaceScene, ALostOrLateCameraIsNamed) {
  LiveSpace space(robot(), 3, joints_);
  std::vector<SharedFrame> frames;
  for (std::size_t k = 0; k < 3; ++k) {
    frames.push_back(observe(k, 3));
    space.put(k, frames[k]);
  }
  for (std::size_t k = 0; k < 3; ++k) ASSERT_TRUE(knows(space, k, frames[k]));
  Query query(robot());
  const double late_s = frames[0]->stamp_s + robot()->settings().time.max_frame_age_s + 0.001;
  EXPECT_EQ(query.ask({.frames = space.newest(), .now_s = late_s}).cameras[0].status,
            CameraStatus::too_old);
  EXPECT_EQ(query.ask({.frames = space.newest(), .now_s = late_s}).status, ResultStatus::degraded);
  FrameTime skewed;
  skewed.status = TimeStatus::skewed;
  frames[0] = observe(0, 4, skewed);
  space.put(0, frames[0]);
  ASSERT_TRUE(knows(space, 0, frames[0]));
  EXPECT_EQ(query.ask({.frames = space.newest()}).cameras[0].time, TimeStatus::skewed);
  space.put(0, nullptr);
  ASSERT_TRUE(knows(space, 0, nullptr));
  EXPECT_EQ(query.ask({.frames = space.newest()}).cameras[0].status, CameraStatus::no_frame);
  EXPECT_EQ(query.ask({.frames = space.newest()}).status, ResultStatus::degraded);
}

TEST_F(LiveSpaceScene, WithoutJointsTheRobotIsWhereItWasSeen) {
  const JointIntake none(robot()->model(), {});
  LiveSpace space(robot(), 1, none);
  const SharedFrame frame = observe(0, 3);
  space.put(0, frame);
  ASSERT_TRUE(knows(space, 0, frame));
  Query query(robot()), plain(robot());
  expect_same(query.ask({.frames = space.newest()}), plain.ask({.frames = *frame}));
}

TEST_F(LiveSpaceScene, WhatItRefusesItTells) {
  for (const std::size_t count : {std::size_t{0}, kMostCameras + 1}) {
    expect_parts(error_message<std::invalid_argument>([&] { LiveSpace(robot(), count, joints_); }),
                 {"cameras: " + std::to_string(count), "1 to 8"});
  }
  LiveSpace space(robot(), 3, joints_);
  EXPECT_THROW(space.put(3, observe(0, 3)), std::out_of_range);
  EXPECT_EQ(space.counts().prepared, 0);
  EXPECT_EQ(space.newest()->frames()[1], nullptr);
}

TEST_F(LiveSpaceScene, CamerasPutWhatTheyObserve) {
  LiveSpace space(robot(), 3, joints_);
  std::vector<std::unique_ptr<LiveCamera>> cameras(3);
  for (std::size_t k = 0; k < 3; ++k) {
    cameras[k] = std::make_unique<LiveCamera>(
        scene_.cameras[k].mounted, joints_, LiveCameraSettings{.max_wait_s = 30},
        [&, k](const SharedFrame& frame, const auto&...) { space.put(k, frame); });
  }
  Query query(robot());
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t k = 0; k < 3; ++k) {
      cameras[k]->push(scene_.cameras[k].source.stamps_s[i], scene_.cameras[k].read_depth(i));
    }
    const auto has_all = [&] {
      const auto newest = space.newest();
      return std::ranges::all_of(std::array{0, 1, 2}, [&](int k) {
        const SharedFrame& frame = newest->frames()[k];
        return frame && frame->stamp_s == scene_.cameras[k].source.stamps_s[i];
      });
    };
    ASSERT_TRUE(comes_true(has_all));
    EXPECT_EQ(query.ask({.frames = space.newest()}).status, ResultStatus::ok);
  }
}

}  // namespace
}  // namespace berth
