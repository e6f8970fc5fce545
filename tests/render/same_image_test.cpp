// An image that went through other hands, and its extent.
#include <gtest/gtest.h>
#include <tbb/global_control.h>
#include <tbb/task_arena.h>

#include "berth/render/robot_renderer.hpp"
#include "berth/robot/primitives.hpp"
#include "tests/render/crowded_robot.hpp"
#include "tests/render/small_robot.hpp"
#include "tests/support/only_target.hpp"
#include "tests/support/same_bits.hpp"

namespace berth {
namespace {

const Camera kUprightCamera{61, 47, 50, 52, 30.2, 22.7};
const Camera kOtherCamera{47, 61, 50, 52, 22.7, 30.2};

/// A few links that are seldom seen all, and sometimes none.
struct Scene {
  RobotModel model;
  RobotPose pose;

  explicit Scene(std::mt19937& random) {
    std::vector<TriangleMesh> meshes;
    std::vector<Pose> X_CL;
    for (int link = 0; link < 2; ++link) {
      meshes.push_back(random_mesh(random));
      X_CL.push_back(random_pose(random, {Eigen::Vector3d(-2, -2, -2), Eigen::Vector3d(2, 2, 4)}));
    }
    model = robot_of(std::move(meshes));
    pose = pose_seen_at(Pose::Identity(), X_CL);
  }

  void render(const Camera& camera, RobotImage& image) const {
    RobotRenderer(build_link_meshes(model), camera).render(pose, Pose::Identity(), image);
  }
  RobotImage fresh(const Camera& camera) const {
    RobotImage image;
    render(camera, image);
    return image;
  }
};

TEST(RobotImageReuse, OneImageServesRobotsAndCamerasInTurn) {
  std::mt19937 random(4);
  RobotImage image;
  for (int trial = 0; trial < 300; ++trial) {
    const Scene scene(random);
    const Camera& camera = random() % 4 == 0 ? kOtherCamera : kUprightCamera;
    scene.render(camera, image);
    ASSERT_TRUE(same_bits(image, scene.fresh(camera))) << trial;
  }
}

TEST(RobotImageReuse, SomebodyElsesImageIsClearedInFull) {
  std::mt19937 random(5);
  for (int trial = 0; trial < 20; ++trial) {
    const Scene scene(random);
    RobotImage image;
    image.depth_m.resize(kUprightCamera.width_px, kUprightCamera.height_px, 0.25F);
    image.link_id.resize(kUprightCamera.width_px, kUprightCamera.height_px, LinkId{7});
    scene.render(kUprightCamera, image);
    EXPECT_TRUE(same_bits(image, scene.fresh(kUprightCamera))) << trial;
  }
}

TEST(RobotImageExtent, HoldsAllRobotPixels) {
  std::mt19937 random(6);
  int robot_pixels = 0;
  for (int trial = 0; trial < 200; ++trial) {
    const RobotImage image = Scene(random).fresh(kUprightCamera);
    const PixelRect& extent = image.extent;
    for (int v = 0; v < kUprightCamera.height_px; ++v) {
      for (int u = 0; u < kUprightCamera.width_px; ++u) {
        if (image.link_id(u, v) == kNoLink) continue;
        ++robot_pixels;
        ASSERT_TRUE(u >= extent.u_begin && u < extent.u_end && v >= extent.v_begin &&
                    v < extent.v_end)
            << trial << ": " << u << " " << v;
      }
    }
  }
  EXPECT_GT(robot_pixels, 10000);
}

TEST(RobotImageExtent, IsNotMuchLargerThanTheRobot) {
  // From 0.7 m to 0.9 m to the right and 0.1 m to both sides of the axis, at 1.9 m to 2.1 m.
  const RobotModel model = robot_of({make_box({0.2, 0.2, 0.2})});
  RobotImage image;
  RobotRenderer(build_link_meshes(model), kUprightCamera)
      .render({{Pose(Eigen::Translation3d(0.8, 0, 2))}}, Pose::Identity(), image);
  EXPECT_GE(image.extent.u_begin, 30.2 + 50 * 0.7 / 2.1 - 3);
  EXPECT_LE(image.extent.u_end, 30.2 + 50 * 0.9 / 1.9 + 3);
  EXPECT_GE(image.extent.v_begin, 22.7 - 52 * 0.1 / 1.9 - 3);
  EXPECT_LE(image.extent.v_end, 22.7 + 52 * 0.1 / 1.9 + 3);
}

// The image does not depend on how many threads draw it, nor on who of them draws what.

const Camera kThreadsCamera{203, 157, 180, 175, 99.4, 80.1};

RobotImage render_with(int threads, const CrowdedRobot& robot, RobotRenderer& renderer) {
  RobotImage image;
  tbb::task_arena(threads).execute([&] { renderer.render(robot.pose, Pose::Identity(), image); });
  return image;
}

TEST(RenderThreads, AnyNumberGivesTheSameImage) {
  const tbb::global_control allow(tbb::global_control::max_allowed_parallelism, 5);
  const CrowdedRobot robot(1);
  RobotRenderer renderer(build_link_meshes(robot.model), kThreadsCamera);
  const RobotImage alone = render_with(1, robot, renderer);
  for (int round = 0; round < 50; ++round) {
    EXPECT_TRUE(same_bits(render_with(1 + round % 5, robot, renderer), alone)) << round;
  }
}

TEST(RenderThreads, AtEqualDepthTheSmallerIdIsSeen) {
  const CrowdedRobot robot(2);
  RobotRenderer renderer(build_link_meshes(robot.model), kThreadsCamera);
  int fifth = 0;
  const RobotImage image = render_with(2, robot, renderer);
  for (const LinkId id : image.link_id.pixels()) {
    EXPECT_NE(id, 6);
    fifth += id == 5;
  }
  EXPECT_GT(fifth, 100);
}

// Every instruction set that this machine has computes the same bits.

const Camera kOddCamera{203, 157, 180, 175, 99.4, 80.1};

TEST(InstructionSets, GiveTheSameRobotImages) {
  for (std::uint32_t seed = 0; seed < 5; ++seed) {
    const CrowdedRobot robot(seed);
    RobotRenderer renderer(build_link_meshes(robot.model), kOddCamera);
    RobotImage best;
    renderer.render(robot.pose, Pose::Identity(), best);
    on_every_target([&](const char* target) {
      SCOPED_TRACE(target);
      RobotImage image;
      renderer.render(robot.pose, Pose::Identity(), image);
      EXPECT_TRUE(same_bits(image, best));
    });
  }
}

}  // namespace
}  // namespace berth
