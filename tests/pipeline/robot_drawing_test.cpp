// A robot that stands still is not rendered again, and nothing else changes.
#include "berth/pipeline/robot_drawing.hpp"

#include <gtest/gtest.h>

#include "berth/pipeline/mounted_camera.hpp"
#include "berth/pipeline/observer.hpp"
#include "berth/pipeline/query.hpp"
#include "berth/scene/open_scene.hpp"

namespace berth {
namespace {

void expect_same_images(const Frame& a, const Frame& b) {
  EXPECT_EQ(a.robot.link_id.pixels(), b.robot.link_id.pixels());
  EXPECT_EQ(a.obstacles.fate.pixels(), b.obstacles.fate.pixels());
  for (std::size_t i = 0; i < a.robot.depth_m.pixels().size(); ++i) {
    const float x = a.robot.depth_m.pixels()[i], y = b.robot.depth_m.pixels()[i];
    ASSERT_TRUE(x == y || (x != x && y != y)) << "pixel " << i;
  }
}

class StandingRobot : public ::testing::Test {
 protected:
  const OpenScene scene_ = open_scene(BERTH_SOURCE_DIR "/data/bundled/scene.yaml");
  const OpenCamera& camera_ = scene_.cameras[0];
  std::shared_ptr<const MountedCamera> mounted_ = camera_.mounted;

  /// With memory of what came before, and without.
  void expect_as_alone(Observer& observer, DepthView depth_m, const JointState& joints) {
    Frame frame, alone;
    observer.observe(depth_m, joints, frame);
    Observer(mounted_).observe(depth_m, joints, alone);
    expect_same_images(frame, alone);
    EXPECT_EQ(frame.pose.X_BL[3].matrix(), alone.pose.X_BL[3].matrix());
  }
};

TEST_F(StandingRobot, IsFilteredFromEachNewImageAsByANewObserver) {
  Observer observer(mounted_);
  const JointState joints = camera_.at_exposure[2];
  for (const int image : {2, 3, 4, 2}) {
    expect_as_alone(observer, camera_.read_depth(image), joints);
  }
}

TEST_F(StandingRobot, IsRenderedAgainAsSoonAsItHasMoved) {
  Observer observer(mounted_);
  JointState joints = camera_.at_exposure[2];
  const DepthImage depth_m = camera_.read_depth(2);
  for (int i = 0; i < 6; ++i) {
    // Twice at each place; the tip moves by tenths of a millimetre.
    if (i % 2 == 0) joints.position[1] += 5e-4;
    expect_as_alone(observer, depth_m, joints);
  }
  expect_as_alone(observer, camera_.read_depth(0), camera_.at_exposure[0]);
}

TEST_F(StandingRobot, NoiseOfItsEncodersDoesNotAddUp) {
  RobotDrawing drawing(*mounted_->robot(), mounted_->camera());
  RobotRenderer renderer(mounted_->robot()->meshes(), mounted_->camera());
  RobotPose pose;
  JointState joints = camera_.at_exposure[2];
  Frame frame;
  Observer(mounted_).observe(camera_.read_depth(2), joints, frame);
  RobotImage drawn, rendered;
  for (int i = 0; i < 200; ++i) {
    joints.position[1] += 1e-6;
    forward_kinematics(mounted_->robot()->model(), joints.position, pose);
    drawing.draw(pose, frame.X_BC, drawn);
  }
  renderer.render(pose, frame.X_BC, rendered);
  int robot_pixels = 0, others = 0, apart = 0;
  for (std::size_t i = 0; i < drawn.depth_m.pixels().size(); ++i) {
    const float x = drawn.depth_m.pixels()[i], y = rendered.depth_m.pixels()[i];
    robot_pixels += y == y;
    others += drawn.link_id.pixels()[i] != rendered.link_id.pixels()[i];
    apart += std::abs(x - y) > 1e-4F;
  }
  // Where a surface is seen along it, a pixel's depth goes farther than the surface.
  EXPECT_LT(apart, 0.01 * robot_pixels);
  EXPECT_LT(others, 0.002 * robot_pixels);
}

}  // namespace
}  // namespace berth
