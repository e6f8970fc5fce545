// The self filter on the GPU against the one on the CPU, from the same robot image.
#include "thesis/opengl/gl_self_filter.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "berth/self_filter/self_filter.hpp"
#include "tests/self_filter/random_scene.hpp"
#include "tests/support/gl_test.hpp"

namespace berth {
namespace {

class GlSelfFilterTest : public testing::GlTest {
 protected:
  void SetUp() override {
    GlTest::SetUp();
    if (testing::shared_gl()) filter_.emplace();
  }
  void TearDown() override {
    filter_.reset();
    GlTest::TearDown();
  }

  ObstacleImage on_gpu(const RandomScene& scene, const RobotImage* region = nullptr) {
    const int width = scene.camera.width_px;
    const int height = scene.camera.height_px;
    GlUpload upload(width, height);
    const GlTexture sensor_depth_m(GlPixel::depth_m, width, height);
    const GlRobotImage robot(width, height);
    const GlObstacleImage out(width, height);
    upload.send(scene.sensor_depth_m, sensor_depth_m);
    upload.send(scene.robot, robot);
    if (region) {
      const GlRobotImage region_on_gpu(width, height);
      upload.send(*region, region_on_gpu);
      filter_->filter(scene.camera, sensor_depth_m, robot, region_on_gpu.link_id, scene.settings,
                      out);
    } else {
      filter_->filter(scene.camera, sensor_depth_m, robot, scene.settings, out);
    }
    ObstacleImage image;
    read_back(out, image);
    EXPECT_EQ(filter_->count(), image.count);
    return image;
  }

  static ObstacleImage on_cpu(const RandomScene& scene, const RobotImage* region = nullptr) {
    SelfFilterWorkspace workspace;
    ObstacleImage out;
    if (region) {
      self_filter(scene.camera, scene.sensor_depth_m, scene.robot, *region, scene.settings,
                  workspace, out);
    } else {
      self_filter(scene.camera, scene.sensor_depth_m, scene.robot, scene.settings, workspace, out);
    }
    return out;
  }

  std::optional<GlSelfFilter> filter_;
};

void expect_same(const ObstacleImage& gpu, const ObstacleImage& cpu) {
  ASSERT_EQ(gpu.fate.pixels().size(), cpu.fate.pixels().size());
  for (int v = 0; v < cpu.fate.height(); ++v) {
    for (int u = 0; u < cpu.fate.width(); ++u) {
      ASSERT_EQ(gpu.fate(u, v), cpu.fate(u, v)) << "pixel " << u << ", " << v;
      const float depth_m = cpu.depth_m(u, v);
      ASSERT_TRUE(std::isnan(depth_m) ? std::isnan(gpu.depth_m(u, v))
                                      : gpu.depth_m(u, v) == depth_m)
          << "pixel " << u << ", " << v;
    }
  }
}

TEST_F(GlSelfFilterTest, GivesTheSameFatesOnRandomScenes) {
  std::array<int, kSelfFilterFateCount> scenes{};
  for (std::uint32_t seed = 0; seed < 90; ++seed) {
    SCOPED_TRACE(seed);
    const RandomScene scene = random_scene(seed);
    const ObstacleImage cpu = on_cpu(scene);
    expect_same(on_gpu(scene), cpu);
    if (HasFatalFailure()) return;
    for (int fate = 0; fate < kSelfFilterFateCount; ++fate) scenes[fate] += cpu.count[fate] > 0;
  }
  // The region has a test of its own.
  EXPECT_GE(*std::min_element(scenes.begin(), std::prev(scenes.end())), 10);
}

TEST_F(GlSelfFilterTest, IgnoresTheSamePixelsOutsideOfARegion) {
  std::int64_t ignored = 0;
  for (std::uint32_t seed = 200; seed < 212; ++seed) {
    SCOPED_TRACE(seed);
    RandomScene scene = random_scene(seed);
    scene.settings.robot_region_scale = 6;
    const RobotImage region =
        sim::random_images(seed, scene.camera.width_px, scene.camera.height_px, 3).robot;
    const ObstacleImage cpu = on_cpu(scene, &region);
    expect_same(on_gpu(scene, &region), cpu);
    if (HasFatalFailure()) return;
    ignored += cpu.count_of(PixelFate::outside_region);
  }
  EXPECT_GT(ignored, 3000);
}

/// Depths that wind through the neighbourhood as one piece, whose pixels no order of joining may
/// tear apart.
TEST_F(GlSelfFilterTest, FollowsAWindingPieceToItsEnd) {
  for (const bool leaves : {false, true}) {
    RandomScene scene{{96, 96, 100, 100, 48, 48}, {}, DepthImage(96, 96, kNoDepth), {}};
    scene.robot = {DepthImage(96, 96, kNoDepth), Image<LinkId>(96, 96, kNoLink)};
    scene.settings.padding_m = 0;
    scene.settings.flying_patch_radius_m = 0.6;
    for (int u = 20; u < 76; ++u) {
      scene.robot.depth_m(u, 10) = 1;
      scene.robot.link_id(u, 10) = 1;
    }
    for (int v = 10; v < 14; ++v) scene.sensor_depth_m(20, v) = 1;
    // A snake of rows joined at alternating ends.
    for (int row = 0; row < 20; ++row) {
      const int v = 14 + 2 * row;
      for (int u = 20; u < 76; ++u) scene.sensor_depth_m(u, v) = 1;
      scene.sensor_depth_m(row % 2 == 0 ? 75 : 20, v + 1) = 1;
    }
    if (leaves) {
      for (int v = 54; v < 96; ++v) scene.sensor_depth_m(20, v) = 1;
    }
    const ObstacleImage cpu = on_cpu(scene);
    EXPECT_EQ(cpu.count_of(PixelFate::flying_patch) == 0, leaves);
    expect_same(on_gpu(scene), cpu);
  }
}

TEST_F(GlSelfFilterTest, NewPaddingsOfLinksAreUsed) {
  RandomScene scene = random_scene(3);
  for (const double padding_m : {0.05, 0.1, 0.0, 0.1}) {
    scene.settings.link_padding_m = {padding_m, padding_m, padding_m};
    expect_same(on_gpu(scene), on_cpu(scene));
  }
  scene.settings.link_padding_m = {};
  expect_same(on_gpu(scene), on_cpu(scene));
}

TEST_F(GlSelfFilterTest, RefusesWhatItCannotDo) {
  RandomScene scene = random_scene(1);
  EXPECT_THROW(on_gpu(scene, &scene.robot), std::invalid_argument);
  scene.settings.robot_region_scale = 6;
  EXPECT_THROW(on_gpu(scene), std::invalid_argument);
  scene.settings.padding_m = -1;
  EXPECT_THROW(on_gpu(scene, &scene.robot), std::invalid_argument);
}

}  // namespace
}  // namespace berth
