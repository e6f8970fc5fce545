// Scenes, image by image.
#include "thesis/image_scene.hpp"

#include <gtest/gtest.h>

#include "berth/pipeline/observer.hpp"
#include "tests/support/error_message.hpp"
#include "thesis/image_query.hpp"

namespace berth {
namespace {

/// The first `images` of each camera.
SceneFile bundled(std::size_t images) {
  SceneFile scene = read_scene(BERTH_SOURCE_DIR "/data/bundled/scene.yaml");
  for (SceneCamera& camera : scene.cameras) {
    camera.depth.resize(images);
    camera.stamps_s.resize(images);
  }
  return scene;
}

TEST(ImageScene, ImagesComeCameraByCameraAndEachIsAskedAlone) {
  const OpenScene scene = open_scene(bundled(2));
  ImageScene images(scene, Method::exact);
  for (const OpenCamera& camera : scene.cameras) {
    Observer observer(camera.mounted);
    for (std::size_t k = 0; k < 2; ++k) {
      ASSERT_TRUE(images.next());
      const ImageResult result = images.ask();
      ASSERT_EQ(result.cameras.size(), 1U);
      EXPECT_EQ(result.cameras[0].camera, camera.source.name);
      EXPECT_EQ(result.frame, static_cast<int>(k));
      EXPECT_EQ(result.stamp_s, camera.at_exposure[k].stamp_s);
      EXPECT_FALSE(result.timing);
      Frame frame;
      observer.observe(camera.read_depth(k), camera.at_exposure[k], frame);
      const ImageResult expected = ImageQuery(scene.robot, Method::exact).ask(frame);
      EXPECT_EQ(result.cameras[0].self_filter, frame.obstacles.count);
      for (std::size_t i = 0; i < expected.links.size(); ++i) {
        EXPECT_EQ(result.links[i].status, expected.links[i].status);
        if (expected.links[i].has_distance()) {
          EXPECT_EQ(result.links[i].distance_m, expected.links[i].distance_m);
        }
      }
    }
  }
  EXPECT_FALSE(images.next());
}

TEST(ImageScene, RepeatedRequestsHaveTheirTimes) {
  const OpenScene scene = open_scene(bundled(1));
  ImageScene images(scene, Method::lattice);
  ASSERT_TRUE(images.next());
  const ImageResult result = images.ask(3);
  ASSERT_TRUE(result.timing);
  EXPECT_EQ(result.timing->repeat, 3);
  EXPECT_EQ(result.timing_name, "evaluate_us");
}

TEST(ImageScene, ACameraThatMovedOrIsImplausibleHasNoAnswer) {
  SceneFile file = bundled(4);
  for (SceneCamera& camera : file.cameras) {
    camera.settings.watch = {.max_seen_through = 0.03, .agreeing_frames = 2, .frames = 2};
  }
  file.cameras[1].X_PC.rotate(Eigen::AngleAxisd(0.05, Eigen::Vector3d::UnitX()));
  file.cameras[2].depth_scale_m = 0.0001;
  const OpenScene scene = open_scene(file);
  ImageScene images(scene, Method::exact);
  EXPECT_TRUE(images.plausibility()[2].is_implausible);
  while (images.next()) {
    const ImageResult result = images.ask();
    const CameraResult& camera = result.cameras[0];
    const CameraStatus expected = camera.camera == file.cameras[2].name ? CameraStatus::implausible
                                  : camera.camera == file.cameras[1].name && result.frame > 0
                                      ? CameraStatus::moved
                                      : CameraStatus::ok;
    EXPECT_EQ(camera.status, expected) << camera.camera << " " << result.frame;
    const bool is_ok = expected == CameraStatus::ok;
    EXPECT_EQ(result.status, is_ok ? ResultStatus::ok : ResultStatus::stale);
    EXPECT_EQ(result.links[0].status == LinkStatus::stale, !is_ok);
  }
}

TEST(ImageScene, SceneWhoseCamerasAreAllImplausibleIsRefused) {
  SceneFile file = bundled(2);
  for (SceneCamera& camera : file.cameras) camera.depth_scale_m *= 4;
  const OpenScene scene = open_scene(file);
  expect_parts(error_message([&] { ImageScene images(scene, Method::exact); }),
               {"camera camera", "the robot is not where it should be"});
}

}  // namespace
}  // namespace berth
