// The robot-shaped region of surveillance in the pipeline.
#include <gtest/gtest.h>

#include "berth/pipeline/observer.hpp"
#include "berth/render/robot_renderer.hpp"
#include "berth/scene/open_scene.hpp"
#include "tests/support/mounted_with.hpp"
#include "thesis/image_query.hpp"

namespace berth {
namespace {

class RobotRegion : public ::testing::Test {
 protected:
  RobotRegion()
      : scene_(open_scene(BERTH_SOURCE_DIR "/data/bundled/one_camera.yaml")),
        camera_(scene_.cameras.front()) {}

  /// The bundled scene with a region.
  std::shared_ptr<const MountedCamera> mounted_with(double scale) const {
    CameraSettings settings = camera_.mounted->settings();
    settings.self_filter.robot_region_scale = scale;
    // It looks at what the region left.
    settings.sensor.phantom_radius_m = 0;
    return testing::mounted_with(*camera_.mounted, settings);
  }

  Frame observe(const std::shared_ptr<const MountedCamera>& mounted, std::size_t i) const {
    Frame frame;
    Observer observer(mounted);
    // Twice, so that the second has the memory of the first.
    observer.observe(camera_.read_depth(i + 1), camera_.at_exposure[i + 1], frame);
    observer.observe(camera_.read_depth(i), camera_.at_exposure[i], frame);
    return frame;
  }

  OpenScene scene_;
  const OpenCamera& camera_;
};

TEST_F(RobotRegion, IgnoresOnlyWhatIsNotSeenThroughIt) {
  const auto mounted = mounted_with(3);
  const Frame all = observe(mounted_with(0), 19);
  const Frame some = observe(mounted, 19);
  RobotPose pose;
  forward_kinematics(mounted->robot()->model(), camera_.at_exposure[19].position, pose);
  RobotImage region;
  RobotRenderer(mounted->region_meshes(), mounted->camera()).render(pose, some.X_BC, region);
  for (std::size_t i = 0; i < region.link_id.pixels().size(); ++i) {
    PixelFate expected = all.obstacles.fate.pixels()[i];
    if (expected == PixelFate::obstacle && region.link_id.pixels()[i] == kNoLink)
      expected = PixelFate::outside_region;
    ASSERT_EQ(some.obstacles.fate.pixels()[i], expected) << i;
  }
  EXPECT_GT(some.obstacles.count_of(PixelFate::outside_region), 10000);
  EXPECT_GT(some.obstacles.count_of(PixelFate::obstacle), 1000);
}

TEST_F(RobotRegion, NeverMakesADistanceSmaller) {
  const auto mounted = mounted_with(2);
  const Frame all = observe(camera_.mounted, 19);
  const Frame some = observe(mounted, 19);
  ImageQuery everything(camera_.mounted->robot(), Method::exact);
  ImageQuery ignoring(mounted->robot(), Method::exact);
  const auto& larger = ignoring.ask(some).links;
  const auto& least = everything.ask(all).links;
  for (std::size_t i = 0; i < least.size(); ++i) {
    if (larger[i].status == LinkStatus::none_in_range) continue;
    EXPECT_GE(larger[i].distance_m, least[i].distance_m);
  }
}

}  // namespace
}  // namespace berth
