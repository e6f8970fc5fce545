// Made-up images need not show the robot; of a real camera's images a missing robot is reported.
#include <gtest/gtest.h>

#include <algorithm>

#include "berth/pipeline/observer.hpp"
#include "berth/pipeline/query.hpp"
#include "berth/scene/open_scene.hpp"

namespace berth {
namespace {

class MadeUpImage : public ::testing::Test {
 protected:
  /// Of a wall behind the robot, which nothing shows.
  const Result& ask(const CameraSettings& settings) {
    const auto mounted = std::make_shared<const MountedCamera>(
        scene_.robot, scene_.cameras[0].mounted->mount(), settings);
    const Camera& camera = mounted->camera();
    Observer(mounted).observe(DepthImage(camera.width_px, camera.height_px, 10.0F),
                              scene_.cameras[0].at_exposure[0], frame_);
    return query_.ask({.frames = frame_});
  }

  OpenScene scene_ = open_scene(BERTH_SOURCE_DIR "/data/bundled/one_camera.yaml");
  Frame frame_;
  Query query_{scene_.robot};
};

TEST_F(MadeUpImage, WithoutTheRobotIsAnsweredAndTold) {
  const Result& result = ask({});
  EXPECT_EQ(result.status, ResultStatus::degraded);
  EXPECT_EQ(result.cameras[0].status, CameraStatus::unconfirmed);
  EXPECT_TRUE(std::ranges::any_of(result.links, [](const LinkResult& link) {
    return link.status == LinkStatus::ok || link.status == LinkStatus::none_in_range;
  }));
}

TEST_F(MadeUpImage, WithoutTheRobotIsRefusedFromTheFirstOneOfARealCameraOn) {
  const Result& result = ask(settings_of_real_camera());
  EXPECT_EQ(result.status, ResultStatus::stale);
  EXPECT_EQ(result.cameras[0].status, CameraStatus::implausible);
  for (const LinkResult& link : result.links) {
    EXPECT_EQ(link.status, LinkStatus::stale);
    EXPECT_FALSE(link.has_distance());
  }
}

TEST_F(MadeUpImage, TheCamerasOfASceneAreReal) {
  EXPECT_FALSE(settings_of_real_camera().watch.tell_only);
  EXPECT_FALSE(SceneCamera{}.settings.watch.tell_only);
  EXPECT_FALSE(scene_.cameras[0].mounted->settings().watch.tell_only);
}

}  // namespace
}  // namespace berth
