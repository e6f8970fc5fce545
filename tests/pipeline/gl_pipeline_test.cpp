// The two clocks on OpenGL, against those of the CPU.
#include "berth/scene/open_scene.hpp"
#include "berth/pipeline/asker.hpp"
#include "berth/opengl/gl_asker.hpp"
#include "berth/opengl/gl_observer.hpp"
#include "berth/pipeline/observer.hpp"
#include "tests/pipeline/web.hpp"
#include "tests/support/error_message.hpp"
#include "tests/support/gl_test.hpp"
#include "tests/support/view_with.hpp"

namespace berth {
namespace {

/// A link's outermost pixel may be the next one on another renderer.
constexpr float kDistanceError_m = 0.005F;

class GlPipeline : public testing::GlTest {
 protected:
  GlPipeline()
      : scene_(open_scene(BERTH_SOURCE_DIR "/data/bundled/one_camera.yaml")),
        camera_(scene_.cameras.front()) {}

  std::shared_ptr<const View> view_with(Method method, const SensorSettings& sensor = {}) const {
    EvaluationSettings evaluation = camera_.view->robot()->settings();
    evaluation.method = method;
    ViewSettings settings = camera_.view->settings();
    settings.sensor = sensor;
    return testing::view_with(*camera_.view, evaluation, settings);
  }

  Frame observe_on_cpu(std::size_t i) const { return observe_on_cpu(i, camera_.read_depth(i)); }
  Frame observe_on_cpu(std::size_t i, const DepthImage& depth_m) const {
    Frame frame;
    Observer(camera_.view).observe(depth_m, camera_.at_exposure[i], frame);
    return frame;
  }

  static void expect_near(const Answer& cpu, const Answer& gl) {
    EXPECT_EQ(gl.frame_stamp_s, cpu.frame_stamp_s);
    EXPECT_EQ(gl.joints_stamp_s, cpu.joints_stamp_s);
    ASSERT_EQ(gl.distances.links.size(), cpu.distances.links.size());
    for (std::size_t i = 0; i < cpu.distances.links.size(); ++i) {
      SCOPED_TRACE("link " + std::to_string(i + 1));
      const LinkDistance& a = cpu.distances.links[i];
      const LinkDistance& b = gl.distances.links[i];
      ASSERT_EQ(b.status, a.status);
      if (a.status == LinkStatus::ok) {
        EXPECT_NEAR(b.distance_m, a.distance_m, kDistanceError_m);
      }
      EXPECT_NEAR(gl.visibility[i].surface.seen, cpu.visibility[i].surface.seen, 0.02);
    }
  }

  OpenScene scene_;
  const OpenCamera& camera_;
};

TEST_F(GlPipeline, AnswersAreThoseOfTheCpu) {
  const auto gl_view = view_with(Method::gl_exact);
  GlObserver observer(gl_view);
  GlAsker gl_asker(gl_view->robot());
  Asker asker(camera_.view->robot());
  GlFrame gl_frame(gl_view->camera());
  for (const std::size_t i : {3, 29}) {
    SCOPED_TRACE(i);
    const Frame frame = observe_on_cpu(i);
    observer.observe(camera_.read_depth(i), camera_.at_exposure[i], gl_frame);
    expect_near(asker.ask(frame), gl_asker.ask(gl_frame));
    const JointState& next = camera_.at_exposure[i + 4];
    expect_near(asker.ask(frame, next), gl_asker.ask(gl_frame, next));

    std::int64_t differing = 0;
    for (int fate = 0; fate < kPixelFateCount; ++fate) {
      differing += std::abs(observer.fate_counts()[fate] - frame.obstacles.count[fate]);
    }
    EXPECT_LT(differing, 60);
  }
}

TEST_F(GlPipeline, WhatIsDoubtfulIsThatOfTheCpu) {
  const auto gl_view = view_with(Method::gl_exact);
  DepthImage depth_m = camera_.read_depth(3);
  draw_web(observe_on_cpu(3).robot, depth_m);
  const Frame frame = observe_on_cpu(3, depth_m);
  GlObserver observer(gl_view);
  GlFrame gl_frame(gl_view->camera());
  observer.observe(depth_m, camera_.at_exposure[3], gl_frame);
  const Answer expected = Asker(camera_.view->robot()).ask(frame);
  GlAsker gl_asker(gl_view->robot());
  int doubts = 0;
  const auto expect_doubts = [&](const Answer& found) {
    for (std::size_t i = 0; i < expected.visibility.size(); ++i) {
      const float expected_m = expected.visibility[i].doubtful_distance_m;
      const float found_m = found.visibility[i].doubtful_distance_m;
      ASSERT_EQ(std::isnan(found_m), std::isnan(expected_m)) << "link " << i + 1;
      if (std::isnan(expected_m)) continue;
      EXPECT_NEAR(found_m, expected_m, kDistanceError_m) << "link " << i + 1;
      ++doubts;
    }
  };
  expect_doubts(gl_asker.ask(gl_frame));
  expect_doubts(gl_asker.ask(frame));
  EXPECT_EQ(doubts % 2, 0) << "both frames tell the same links";
  EXPECT_GT(doubts, 0);
}

TEST_F(GlPipeline, AFrameOfTheCpuIsUploadedForTheQuestion) {
  const auto gl_view = view_with(Method::gl_exact);
  GlAsker gl_asker(gl_view->robot());
  const Frame frame = observe_on_cpu(12);
  const Answer& found = gl_asker.ask(frame);
  const Answer expected = Asker(camera_.view->robot()).ask(frame);
  for (std::size_t i = 0; i < found.distances.links.size(); ++i) {
    EXPECT_NEAR(found.distances.links[i].distance_m, expected.distances.links[i].distance_m, 2e-5);
  }
}

TEST_F(GlPipeline, AFrameReadBackIsWhatWasAsked) {
  const auto gl_view = view_with(Method::gl_exact);
  GlObserver observer(gl_view);
  GlFrame gl_frame(gl_view->camera());
  observer.observe(camera_.read_depth(5), camera_.at_exposure[5], gl_frame);
  Frame frame;
  read_back(gl_frame, frame);
  EXPECT_EQ(frame.stamp_s, camera_.at_exposure[5].stamp_s);
  EXPECT_EQ(frame.obstacles.count, observer.fate_counts());
  const auto from_gpu = GlAsker(gl_view->robot()).ask(gl_frame).distances.links;
  const auto from_cpu = Asker(camera_.view->robot()).ask(frame).distances.links;
  for (std::size_t i = 0; i < from_cpu.size(); ++i) {
    EXPECT_NEAR(from_gpu[i].distance_m, from_cpu[i].distance_m, 2e-5);
  }
}

TEST_F(GlPipeline, AnUntimelyFrameHasNoAnswerAndNoImages) {
  const auto gl_view = view_with(Method::gl_exact);
  GlObserver observer(gl_view);
  GlAsker asker(gl_view->robot());
  GlFrame gl_frame(gl_view->camera());
  observer.observe(camera_.read_depth(5), camera_.at_exposure[5], gl_frame);
  asker.ask(gl_frame);
  FrameTime late;
  late.status = TimeStatus::missing_joint;
  observer.observe(camera_.read_depth(5), camera_.at_exposure[6], gl_frame, late);
  for (const LinkDistance& link : asker.ask(gl_frame).distances.links) {
    EXPECT_EQ(link.status, LinkStatus::untimely);
    EXPECT_TRUE(std::isnan(link.distance_m));
  }
  Frame frame;
  read_back(gl_frame, frame);
  const std::int64_t all = std::int64_t{640} * 480;
  EXPECT_EQ(frame.obstacles.count_of(PixelFate::no_reading), all);
  EXPECT_EQ(observer.fate_counts(), frame.obstacles.count);
}

TEST_F(GlPipeline, AMethodOfTheOtherBackendIsRefused) {
  const auto gl_view = view_with(Method::gl_exact);
  EXPECT_EQ(error_message<std::invalid_argument>([&] { Asker asker(gl_view->robot()); }),
            "method gl_exact runs on OpenGL; expected one that does not");
  EXPECT_EQ(error_message<std::invalid_argument>([&] { GlAsker asker(camera_.view->robot()); }),
            "method exact does not run on OpenGL; expected one that does");
}

TEST_F(GlPipeline, ASensorRuleIsRefusedByName) {
  const auto refusal = [&](const SensorSettings& sensor) {
    const auto view = view_with(Method::gl_exact, sensor);
    return error_message<std::invalid_argument>([&] { GlObserver observer(view); });
  };
  const std::string rest = ": runs on the CPU alone; expected it off on OpenGL";
  EXPECT_EQ(refusal({.speckle_px = 20}), "sensor.speckle_px" + rest);
  EXPECT_EQ(refusal({.average_frames = 3}), "sensor.average_frames" + rest);
  EXPECT_EQ(refusal({.background_frames = 3}), "sensor.background_frames" + rest);
  EXPECT_EQ(refusal({.holes = HolePolicy::obstacle}), "sensor.holes" + rest);
  EXPECT_EQ(refusal({}), "");
}

TEST_F(GlPipeline, AWatchIsRefusedByName) {
  for (const WatchSettings& watch :
       {WatchSettings{.max_seen_through = 0.03}, WatchSettings{.max_displacement_m = 0.02}}) {
    ViewSettings settings = camera_.view->settings();
    settings.watch = watch;
    const auto view = testing::view_with(*camera_.view, settings);
    EXPECT_EQ(error_message<std::invalid_argument>([&] { GlObserver observer(view); }),
              "watch: a camera is watched on the CPU alone; expected max_seen_through and "
              "max_displacement_m to be 0 on OpenGL");
  }
}

TEST_F(GlPipeline, AnImageOfAnotherSizeIsRefused) {
  const auto gl_view = view_with(Method::gl_exact);
  GlObserver observer(gl_view);
  GlFrame frame(gl_view->camera());
  EXPECT_EQ(error_message<std::invalid_argument>(
                [&] { observer.observe(DepthImage(3, 2, 1.0F), camera_.at_exposure[0], frame); }),
            "depth image: 3 x 2 px; expected the camera's 640 x 480");
}

}  // namespace
}  // namespace berth
