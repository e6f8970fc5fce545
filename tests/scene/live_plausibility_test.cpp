// Running cameras: the bundled ones, with a focal length that is a tenth off, and other mistakes.
#include "berth/scene/live_plausibility.hpp"

#include <gtest/gtest.h>

#include <utility>

#include "berth/scene/open_scene.hpp"
#include "tests/support/error_message.hpp"

namespace berth {
namespace {

const OpenScene& bundled() {
  static const OpenScene scene = open_scene(BERTH_SOURCE_DIR "/data/bundled/scene.yaml");
  return scene;
}

/// Images of a bundled camera, the arm in another pose in each.
LiveImages images_of(std::size_t camera, std::size_t count) {
  const OpenCamera& source = bundled().cameras[camera];
  LiveImages live{source.mounted, source.source.depth_scale_m, {}};
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t k = i * (source.source.depth.size() - 1) / count;
    live.images.push_back(
        {std::make_shared<const DepthImage>(source.read_depth(k)), source.at_exposure[k]});
  }
  return live;
}

LiveImages with_focal_length(LiveImages live, double factor, WatchSettings watch = {}) {
  CameraMount mount = live.mounted->mount();
  mount.camera.fx_px *= factor;
  mount.camera.fy_px *= factor;
  CameraSettings settings = live.mounted->settings();
  settings.watch = watch;
  live.mounted = std::make_shared<const MountedCamera>(live.mounted->robot(), mount, settings);
  return live;
}

TEST(LivePlausibility, CamerasThatAreRightAreRight) {
  std::vector<LiveImages> cameras;
  for (std::size_t c = 0; c < bundled().cameras.size(); ++c)
    cameras.push_back(images_of(c, kLeastPosesForFocalLength));
  for (const CameraPlausibility& camera : find_implausible(cameras)) {
    EXPECT_FALSE(camera.is_implausible) << text_of(camera);
    EXPECT_EQ(text_of(camera), "");
    EXPECT_EQ(camera.frames, kLeastPosesForFocalLength);
  }
}

TEST(LivePlausibility, AFocalLengthThatIsATenthOffIsTold) {
  // Of the first and the last camera a fit does not get from 1.1 to the right pose.
  for (const std::size_t c : {0, 1, 2}) {
    const LiveImages live = images_of(c, kLeastPosesForFocalLength);
    const auto right_px = static_cast<int>(live.mounted->mount().camera.fx_px);
    for (const double factor : {0.9, 1.1}) {
      const CameraPlausibility found = find_implausible({with_focal_length(live, factor)})[0];
      EXPECT_TRUE(found.is_implausible) << found.camera << ", " << factor;
      const std::string text = text_of(found);
      const std::string fitted = "with a focal length of ", tried = "the focal length is about ";
      const std::size_t at = text.find(fitted);
      if (at == std::string::npos) {
        // In steps, without a fit.
        const std::size_t cause = text.find(tried);
        ASSERT_NE(cause, std::string::npos) << text;
        EXPECT_NEAR(std::stod(text.substr(cause + tried.size())), right_px, 0.03 * right_px)
            << text;
        continue;
      }
      EXPECT_NEAR(std::stod(text.substr(at + fitted.size())), right_px, 0.01 * right_px) << text;
    }
  }
}

TEST(LivePlausibility, FewPosesTellNoFocalLength) {
  const LiveImages few = images_of(1, kLeastPosesForFocalLength - 1);
  EXPECT_FALSE(find_implausible({with_focal_length(few, 0.9)})[0].is_implausible);
}

TEST(LivePlausibility, WithTheLimitAtZeroNobodyLooks) {
  const LiveImages off = with_focal_length(images_of(1, 6), 0.9, {.min_at_robot = 0});
  EXPECT_FALSE(find_implausible({off})[0].is_implausible);
}

TEST(LivePlausibility, ASimpleMistakeIsNamedAndContradictedByOtherCameras) {
  std::vector<LiveImages> cameras = {images_of(0, 2), images_of(1, 2)};
  for (LiveImage& image : cameras[1].images) {
    DepthImage depth_m = *image.depth_m;
    for (float& z_m : depth_m.pixels()) z_m *= 10;
    image.depth_m = std::make_shared<const DepthImage>(std::move(depth_m));
  }
  const std::vector<CameraPlausibility> found = find_implausible(cameras);
  EXPECT_EQ(text_of(found[0]), "");
  expect_parts(text_of(found[1]), {"camera left", "depth_scale is 0.0001"});
}

TEST(LivePlausibility, PauseEndsIt) {
  struct Stopped {};
  EXPECT_THROW(find_implausible({images_of(1, 6)}, [] { throw Stopped(); }), Stopped);
}

}  // namespace
}  // namespace berth
