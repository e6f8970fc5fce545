// Requests about the newest frames of running cameras.
#include "berth/pipeline/query.hpp"

#include <gtest/gtest.h>
#include <malloc.h>

#include <algorithm>
#include <array>
#include <atomic>

#include "berth/live/live_camera.hpp"
#include "berth/pipeline/observer.hpp"
#include "berth/scene/scene_run.hpp"
#include "tests/live/live_scene.hpp"
#include "tests/support/error_message.hpp"

namespace berth {
namespace {

using LiveFrames = std::vector<std::shared_ptr<const Frame>>;

std::vector<float> distances_of(const Result& result) {
  std::vector<float> out;
  for (const LinkResult& link : result.links) out.push_back(link.distance_m);
  return out;
}

void expect_near(const std::vector<float>& got, const std::vector<float>& expected) {
  ASSERT_EQ(got.size(), expected.size());
  for (std::size_t i = 0; i < got.size(); ++i) {
    if (std::isnan(expected[i])) {
      EXPECT_TRUE(std::isnan(got[i])) << i;
    } else {
      EXPECT_NEAR(got[i], expected[i], 1e-5) << i;
    }
  }
}

std::shared_ptr<const Frame> observe(const OpenCamera& camera, std::size_t i) {
  Observer observer(camera.mounted);
  auto frame = std::make_shared<Frame>();
  observer.observe(camera.read_depth(i), camera.at_exposure[i], *frame, camera.exposure_time[i]);
  return frame;
}

class AskedScene : public ::testing::Test {
 protected:
  AskedScene() : scene_(open_scene(BERTH_SOURCE_DIR "/data/bundled/scene.yaml")) {
    push_joints(scene_, -1, 10, joints_);
    for (const OpenCamera& camera : scene_.cameras) frames_.push_back(observe(camera, 0));
  }
  double newest_s() const {
    double newest_s = 0;
    for (const auto& frame : frames_) newest_s = std::max(newest_s, frame->stamp_s);
    return newest_s;
  }
  /// The newest joints at this time.
  const JointBuffer& joints_at(double time_s) {
    newest_.clear();
    JointState joints;
    joints_.buffer().at(time_s, kOnlyBetweenSamples, joints);
    newest_.push(time_s, joint_names(scene_.robot->model()), joints.position);
    return newest_;
  }

  OpenScene scene_;
  JointIntake joints_{scene_.robot->model(), {}};
  JointBuffer newest_{scene_.robot->model(), 2};
  LiveFrames frames_;
};

TEST_F(AskedScene, WholeSceneGivesWhatSceneRunGives) {
  SceneRun run(scene_);
  Query query(scene_.robot);
  LiveFrames frames(scene_.cameras.size());
  for (int line = 0; line < 5 && run.next(); ++line) {
    frames[run.camera_number()] = observe(run.camera(), run.frame_number());
    const Result expected = run.ask();
    const Result& result = query.ask({frames});
    EXPECT_EQ(result.stamp_s, expected.stamp_s);
    EXPECT_EQ(result.status, expected.status);
    expect_near(distances_of(result), distances_of(expected));
    for (std::size_t c = 0; c < frames.size(); ++c) {
      EXPECT_EQ(result.cameras[c].status, expected.cameras[c].status);
    }
  }
}

TEST_F(AskedScene, AnyJointsAreThoseOfABufferThatHasThem) {
  JointState joints;
  const double now_s = newest_s();
  joints_.buffer().at(now_s, kOnlyBetweenSamples, joints);
  Query of_buffer(scene_.robot), with_time(scene_.robot), without_time(scene_.robot);
  const std::vector<float> expected =
      distances_of(of_buffer.ask({frames_, joints_at(now_s), now_s}));
  expect_near(distances_of(with_time.ask({frames_, joints, now_s})), expected);
  const Result& timeless = without_time.ask({frames_, joints});
  expect_near(distances_of(timeless), expected);
  EXPECT_TRUE(std::isnan(timeless.time.frame_age_s));
  EXPECT_EQ(with_time.ask({frames_, {}, now_s + 10}).time.status, TimeStatus::stale_frame);
  joints.position.pop_back();
  expect_parts(error_message<std::invalid_argument>([&] {
                 with_time.ask({frames_, joints});
               }),
               {"6", "7"});
}

TEST_F(AskedScene, ACameraThatStopsIsLeftOutOnceItIsTooOld) {
  Query query(scene_.robot);
  const double max_age_s = scene_.robot->settings().time.max_frame_age_s;
  const double now_s = newest_s();
  for (const CameraResult& camera : query.ask({frames_, joints_at(now_s), now_s}).cameras) {
    EXPECT_EQ(camera.status, CameraStatus::ok);
  }
  const double later_s = frames_[0]->stamp_s + max_age_s + 0.001;
  ASSERT_LT(later_s, frames_[1]->stamp_s + max_age_s);
  const Result& result = query.ask({frames_, joints_at(later_s), later_s});
  EXPECT_EQ(result.cameras[0].status, CameraStatus::too_old);
  EXPECT_EQ(result.cameras[1].status, CameraStatus::ok);
  EXPECT_EQ(result.time.status, TimeStatus::ok) << "the others' answer stands";
  EXPECT_EQ(result.status, ResultStatus::degraded);
  EXPECT_EQ(query.ask({frames_, joints_at(now_s + 1), now_s + 1}).time.status,
            TimeStatus::stale_frame);
}

TEST_F(AskedScene, AgesAreThoseOfTheRequest) {
  Query query(scene_.robot);
  for (const double wait_s : {0.001, 0.01}) {
    const double now_s = newest_s() + wait_s;
    const Result& result = query.ask({frames_, joints_at(now_s), now_s});
    EXPECT_NEAR(result.cameras[1].age_s, now_s - frames_[1]->stamp_s, 1e-12);
  }
}

TEST_F(AskedScene, OldJointsAndNoFramesAreStatuses) {
  Query query(scene_.robot);
  const double now_s = newest_s() + 0.1;
  EXPECT_EQ(query.ask({frames_, joints_at(now_s - 0.05), now_s}).time.status,
            TimeStatus::stale_joints);
  const LiveFrames none(3);
  EXPECT_EQ(query.ask({none, joints_at(now_s), now_s}).time.status, TimeStatus::no_frame);
  EXPECT_EQ(query.ask({none}).time.status, TimeStatus::no_frame);
  for (const LinkResult& link : query.ask({none}).links) {
    EXPECT_EQ(link.status, LinkStatus::stale);
  }
}

TEST_F(AskedScene, CamerasRunWhileRequestsAreAsked) {
  // The first one of a robot finds which of its links always touch, for longer than the images
  // last.
  Query query(scene_.robot);
  std::vector<std::unique_ptr<LiveCamera>> cameras;
  for (const OpenCamera& camera : scene_.cameras) {
    cameras.push_back(std::make_unique<LiveCamera>(camera.mounted, joints_,
                                                   LiveCameraSettings{.max_wait_s = 30}));
  }
  std::atomic<bool> stop = false;
  std::jthread feeder([&] {
    for (std::size_t i = 0; i < 4; ++i) {
      for (std::size_t c = 0; c < 3; ++c) {
        const OpenCamera& from = scene_.cameras[c];
        cameras[c]->push(from.source.stamps_s[i], from.read_depth(i));
        comes_true([&] { return cameras[c]->counts().images > static_cast<int>(i); });
      }
    }
    stop = true;
  });
  int answers = 0;
  while (!stop) {
    LiveFrames frames;
    for (const auto& camera : cameras) frames.push_back(camera->newest());
    answers += query.ask({frames}).time.status == TimeStatus::ok;
  }
  EXPECT_GT(answers, 0);
}

TEST_F(AskedScene, MemoryStaysAsItIsOnceWarm) {
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
  GTEST_SKIP() << "a sanitizer has its own memory, and takes minutes for it";
#endif
  const OpenCamera& from = scene_.cameras[0];
  const std::vector<std::string> names = joint_names(scene_.robot->model());
  JointIntake joints(scene_.robot->model(), {});
  LiveCamera camera(from.mounted, joints, LiveCameraSettings{.max_wait_s = 30});
  Query query(scene_.robot);
  const DepthImage image = from.read_depth(0);
  double time_s = 0;
  int images = 0;
  const auto run = [&](int count) {
    for (int i = 0; i < count; ++i, ++images) {
      DepthImage copy = camera.spare_image();
      copy = image;
      camera.push(time_s, std::move(copy));
      for (int k = 0; k < 20; ++k, time_s += 0.001) {
        joints.push(time_s, names, from.at_exposure[(i + k) % from.at_exposure.size()].position);
        camera.look_again();
      }
      ASSERT_TRUE(comes_true([&] { return camera.counts().images > images; }));
      const LiveFrames newest = {camera.newest()};
      query.ask({newest, joints.buffer(), time_s});
    }
    malloc_trim(0);
  };
  const auto used = [] {
    const struct mallinfo2 info = mallinfo2();
    return static_cast<std::int64_t>(info.uordblks + info.hblkhd);
  };
  run(60);
  // Once in a while an image is pushed before the last one's memory came back, and another one is
  // made, which is kept. What leaks grows in each round.
  std::array<std::int64_t, 9> growth_bytes;
  for (std::int64_t& growth : growth_bytes) {
    const std::int64_t before = used();
    run(20);
    growth = used() - before;
  }
  std::ranges::nth_element(growth_bytes, growth_bytes.begin() + 4);
  EXPECT_LT(growth_bytes[4], 1000);
}

}  // namespace
}  // namespace berth
