// The two clocks on OpenGL, against those of the CPU.
#include "berth/pipeline/observer.hpp"
#include "berth/robot/primitives.hpp"
#include "berth/scene/open_scene.hpp"
#include "tests/support/error_message.hpp"
#include "tests/support/gl_test.hpp"
#include "tests/support/mounted_with.hpp"
#include "thesis/image_method.hpp"
#include "thesis/image_query.hpp"
#include "thesis/opengl/gl_image_query.hpp"
#include "thesis/opengl/gl_observer.hpp"

namespace berth {
namespace {

/// A link's outermost pixel may be the next one on another renderer.
constexpr float kDistanceError_m = 0.005F;

class GlPipeline : public testing::GlTest {
 protected:
  GlPipeline()
      : scene_(open_scene(BERTH_SOURCE_DIR "/data/bundled/one_camera.yaml")),
        camera_(scene_.cameras.front()) {
    // They are dropped on the CPU alone.
    scene_.cameras.front().mounted = mounted_with({.phantom_radius_m = 0});
  }

  std::shared_ptr<const MountedCamera> mounted_with(const SensorSettings& sensor) const {
    CameraSettings settings = camera_.mounted->settings();
    settings.sensor = sensor;
    return testing::mounted_with(*camera_.mounted, settings);
  }

  Frame observe_on_cpu(std::size_t i) const { return observe_on_cpu(i, camera_.read_depth(i)); }
  Frame observe_on_cpu(std::size_t i, const DepthImage& depth_m) const {
    Frame frame;
    Observer(camera_.mounted).observe(depth_m, camera_.at_exposure[i], frame);
    return frame;
  }

  /// Images of this program's memory are uploaded for each request.
  ImageQuery on_gl() const {
    return {scene_.robot, Method::gl_exact, {}, make_gl_method(Method::gl_exact)};
  }

  static void expect_near(const Result& cpu, const Result& gl) {
    EXPECT_EQ(gl.stamp_s, cpu.stamp_s);
    EXPECT_EQ(gl.joints_stamp_s, cpu.joints_stamp_s);
    ASSERT_EQ(gl.links.size(), cpu.links.size());
    for (std::size_t i = 0; i < cpu.links.size(); ++i) {
      SCOPED_TRACE("link " + std::to_string(i + 1));
      const LinkResult& a = cpu.links[i];
      const LinkResult& b = gl.links[i];
      ASSERT_EQ(b.status, a.status);
      if (a.status == LinkStatus::ok) {
        EXPECT_NEAR(b.distance_m, a.distance_m, kDistanceError_m);
        EXPECT_NEAR((b.obstacle_point_B_m - b.robot_point_B_m).norm(), b.distance_m, 1e-5);
      }
    }
  }

  OpenScene scene_;
  const OpenCamera& camera_;
};

TEST_F(GlPipeline, AnswersAreThoseOfTheCpu) {
  const auto& gl_view = camera_.mounted;
  GlObserver observer(gl_view);
  GlImageQuery gl_query(scene_.robot, Method::gl_exact);
  ImageQuery query(scene_.robot, Method::exact);
  GlFrame gl_frame(gl_view->camera());
  for (const std::size_t i : {3, 29}) {
    SCOPED_TRACE(i);
    const Frame frame = observe_on_cpu(i);
    observer.observe(camera_.read_depth(i), camera_.at_exposure[i], gl_frame);
    expect_near(query.ask(frame), gl_query.ask(gl_frame));
    const JointState& next = camera_.at_exposure[i + 4];
    expect_near(query.ask(frame, next), gl_query.ask(gl_frame, next));

    std::int64_t differing = 0;
    for (int fate = 0; fate < kPixelFateCount; ++fate) {
      differing += std::abs(observer.fate_counts()[fate] - frame.obstacles.count[fate]);
    }
    EXPECT_LT(differing, 60);
  }
}

TEST_F(GlPipeline, AFrameOfTheCpuIsUploadedForTheRequest) {
  ImageQuery gl_query = on_gl();
  const Frame frame = observe_on_cpu(12);
  const ImageResult& found = gl_query.ask(frame);
  const ImageResult expected = ImageQuery(scene_.robot, Method::exact).ask(frame);
  for (std::size_t i = 0; i < found.links.size(); ++i) {
    EXPECT_NEAR(found.links[i].distance_m, expected.links[i].distance_m, 2e-5);
  }
}

TEST_F(GlPipeline, AFrameReadBackIsWhatWasAsked) {
  const auto& gl_view = camera_.mounted;
  GlObserver observer(gl_view);
  GlFrame gl_frame(gl_view->camera());
  observer.observe(camera_.read_depth(5), camera_.at_exposure[5], gl_frame);
  Frame frame;
  read_back(gl_frame, frame);
  EXPECT_EQ(frame.stamp_s, camera_.at_exposure[5].stamp_s);
  EXPECT_EQ(frame.obstacles.count, observer.fate_counts());
  const auto from_gpu = GlImageQuery(scene_.robot, Method::gl_exact).ask(gl_frame).links;
  const auto from_cpu = ImageQuery(scene_.robot, Method::exact).ask(frame).links;
  for (std::size_t i = 0; i < from_cpu.size(); ++i) {
    EXPECT_NEAR(from_gpu[i].distance_m, from_cpu[i].distance_m, 2e-5);
  }
}

TEST_F(GlPipeline, AStaleFrameHasNoAnswerAndNoImages) {
  const auto& gl_view = camera_.mounted;
  GlObserver observer(gl_view);
  GlImageQuery query(scene_.robot, Method::gl_exact);
  GlFrame gl_frame(gl_view->camera());
  observer.observe(camera_.read_depth(5), camera_.at_exposure[5], gl_frame);
  query.ask(gl_frame);
  FrameTime late;
  late.status = TimeStatus::missing_joint;
  observer.observe(camera_.read_depth(5), camera_.at_exposure[6], gl_frame, late);
  for (const LinkResult& link : query.ask(gl_frame).links) {
    EXPECT_EQ(link.status, LinkStatus::stale);
    EXPECT_TRUE(std::isnan(link.distance_m));
  }
  Frame frame;
  read_back(gl_frame, frame);
  const std::int64_t all = std::int64_t{640} * 480;
  EXPECT_EQ(frame.obstacles.count_of(PixelFate::no_reading), all);
  EXPECT_EQ(observer.fate_counts(), frame.obstacles.count);
}

TEST_F(GlPipeline, AMethodOfTheOtherBackendIsRefused) {
  const auto refusal = [](auto make) { return error_message<std::invalid_argument>(make); };
  EXPECT_EQ(refusal([&] { ImageQuery query(scene_.robot, Method::gl_exact); }),
            "method gl_exact runs on OpenGL; expected one that does not");
  const std::string of_gl = "method exact does not run on OpenGL; expected one that does";
  EXPECT_EQ(refusal([&] { GlImageQuery query(scene_.robot, Method::exact); }), of_gl);
  EXPECT_EQ(refusal([] { make_gl_method(Method::exact); }), of_gl);
}

TEST_F(GlPipeline, ASensorRuleIsRefusedByName) {
  const auto refusal = [&](const SensorSettings& sensor) {
    const auto mounted = mounted_with(sensor);
    return error_message<std::invalid_argument>([&] { GlObserver observer(mounted); });
  };
  const std::string rest = ": runs on the CPU alone; expected it off on OpenGL";
  EXPECT_EQ(refusal({.speckle_px = 20}), "sensor.speckle_px" + rest);
  EXPECT_EQ(refusal({.background_frames = 3}), "sensor.background_frames" + rest);
  EXPECT_EQ(refusal({}), "");
}

TEST_F(GlPipeline, AWatchIsRefusedByName) {
  for (const WatchSettings& watch :
       {WatchSettings{.max_seen_through = 0.03}, WatchSettings{.max_displacement_m = 0.02}}) {
    CameraSettings settings = camera_.mounted->settings();
    settings.watch = watch;
    const auto mounted = testing::mounted_with(*camera_.mounted, settings);
    EXPECT_EQ(error_message<std::invalid_argument>([&] { GlObserver observer(mounted); }),
              "watch: a camera is watched on the CPU alone; expected max_seen_through and "
              "max_displacement_m to be 0 on OpenGL");
  }
}

TEST_F(GlPipeline, WhatIsSoftIsRefused) {
  Attachment hose{"hose", "arm_link_7", make_sphere(0.1)};
  hose.is_soft = true;
  const auto mounted = with_robot(*camera_.mounted, attach(*camera_.mounted->robot(), hose));
  EXPECT_EQ(
      error_message<std::invalid_argument>([&] { GlObserver observer(mounted); }),
      "attached: what is soft is taken out on the CPU alone; expected nothing soft on OpenGL");
}

TEST_F(GlPipeline, AnImageOfAnotherSizeIsRefused) {
  const auto& gl_view = camera_.mounted;
  GlObserver observer(gl_view);
  GlFrame frame(gl_view->camera());
  EXPECT_EQ(error_message<std::invalid_argument>(
                [&] { observer.observe(DepthImage(3, 2, 1.0F), camera_.at_exposure[0], frame); }),
            "depth image: 3 x 2 px; expected the camera's 640 x 480");
}

}  // namespace
}  // namespace berth
