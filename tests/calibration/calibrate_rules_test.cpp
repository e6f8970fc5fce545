// What holds of every calibration, whatever the images: it repeats, stops, and refuses.
#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <stdexcept>

#include "berth/render/robot_renderer.hpp"
#include "berth/robot/kinematics.hpp"
#include "tests/calibration/found_error.hpp"

namespace berth {
namespace {

using sim::DrawnCalibrationData;

/// Small images, so that it is quick.
DrawnCalibrationData draw_small(std::uint32_t seed, int poses = 5) {
  return coarse_arm().draw({.width_px = 160, .height_px = 120, .poses = poses}, seed);
}

void expect_same(const CameraCalibration& a, const CameraCalibration& b) {
  EXPECT_EQ(a.X_PC.matrix(), b.X_PC.matrix());
  EXPECT_EQ(a.sigma_xyz_m, b.sigma_xyz_m);
  EXPECT_EQ(a.sigma_rotation_rad, b.sigma_rotation_rad);
  EXPECT_EQ(a.clock_offset_s, b.clock_offset_s);
  EXPECT_EQ(a.depth.offset_m, b.depth.offset_m);
  EXPECT_EQ(a.depth.scale, b.depth.scale);
  EXPECT_EQ(a.dilation_px, b.dilation_px);
  EXPECT_EQ(a.moved_m, b.moved_m);
  EXPECT_EQ(a.halves_m, b.halves_m);
  EXPECT_EQ(a.before.p90_m, b.before.p90_m);
  EXPECT_EQ(a.after.p90_m, b.after.p90_m);
  EXPECT_EQ(a.score_after, b.score_after);
  EXPECT_EQ(a.not_determined, b.not_determined);
  EXPECT_EQ(a.refused, b.refused);
}

TEST(CalibrateRules, OneThreadFindsTheSameBits) {
  DrawnCalibrationData drawn = draw_small(1);
  disturb(drawn, 0.05, 5 * kDegree, 1);
  const CalibrationResult many = calibrate(drawn.calibration_data, {.joint_zeros = true});
  const tbb::global_control one_thread(tbb::global_control::max_allowed_parallelism, 1);
  const CalibrationResult one = calibrate(drawn.calibration_data, {.joint_zeros = true});
  expect_same(many.cameras[0], one.cameras[0]);
  EXPECT_EQ(many.joint_offsets, one.joint_offsets);
  EXPECT_EQ(many.joints_not_determined, one.joints_not_determined);
}

TEST(CalibrateRules, ACameraIsFoundBesideOthersAsItIsAlone) {
  DrawnCalibrationData left = draw_small(1, 3);
  DrawnCalibrationData right = draw_small(2, 3);
  disturb(left, 0.05, 5 * kDegree, 1);
  disturb(right, 0.05, 5 * kDegree, 2);
  right.camera->name = "right";
  CalibrationData both = left.calibration_data;
  both.joints = nullptr;
  both.cameras = {left.camera.get(), right.camera.get()};
  const CalibrationResult found = calibrate(both);
  ASSERT_EQ(found.cameras.size(), 2U);
  EXPECT_EQ(found.cameras[1].camera, "right");
  expect_same(found.cameras[0], calibrate(left.calibration_data).cameras[0]);
  expect_same(found.cameras[1], calibrate(right.calibration_data).cameras[0]);
}

TEST(CalibrateRules, APauseThatThrowsStopsIt) {
  const DrawnCalibrationData drawn = draw_small(1);
  int pauses = 0;
  const auto stop = [&pauses] {
    if (++pauses == 3) throw std::runtime_error("stopped");
  };
  EXPECT_THROW(calibrate(drawn.calibration_data, {.pause = stop}), std::runtime_error);
  EXPECT_EQ(pauses, 3);
}

/// No pose explains the images; the start's is told. Gives the sentence.
std::string expect_refused(const DrawnCalibrationData& drawn) {
  const CameraCalibration found = calibrate(drawn.calibration_data).cameras[0];
  EXPECT_FALSE(found.is_found);
  EXPECT_NE(
      found.refused.find("no pose was found that explains the images: the best fits them by "),
      std::string::npos)
      << found.refused;
  EXPECT_NE(found.refused.find(" %; expected 40 % at least"), std::string::npos) << found.refused;
  EXPECT_EQ(found.X_PC.matrix(), drawn.camera->X_PC.matrix());
  EXPECT_TRUE(std::isnan(found.halves_m));
  return found.refused;
}

TEST(CalibrateRules, ACameraThatSeesNoRobotIsRefused) {
  // The room alone, from where there are readings.
  DrawnCalibrationData drawn = draw_small(1, 3);
  for (CalibrationFrame& frame : drawn.camera->frames) {
    std::fill(frame.depth_m.pixels().begin(), frame.depth_m.pixels().end(), 3.5F);
  }
  expect_refused(drawn);
  // And one that looks away, so that the robot is never in the image.
  DrawnCalibrationData away = draw_small(1, 3);
  away.camera->X_PC =
      away.camera->X_PC * Eigen::AngleAxisd(std::numbers::pi, Eigen::Vector3d::UnitY());
  EXPECT_TRUE(expect_refused(away).starts_with(
      "nothing of the robot is seen where the scene has the camera, in any of its 3 frames, and no "
      "pose was found that explains the images: the best fits them by "));
}

TEST(CalibrateRules, ImagesOfNoiseAreRefused) {
  DrawnCalibrationData drawn = draw_small(1, 3);
  sim::Random random(5);
  for (CalibrationFrame& frame : drawn.camera->frames) {
    for (float& z_m : frame.depth_m.pixels()) z_m = static_cast<float>(random(0.3, 4));
  }
  expect_refused(drawn);
}

TEST(CalibrateRules, ImagesWithoutAReadingAreRefused) {
  DrawnCalibrationData drawn = draw_small(1, 3);
  for (CalibrationFrame& frame : drawn.camera->frames) {
    frame.depth_m.resize(160, 120, kNoDepth);
  }
  expect_refused(drawn);
}

TEST(CalibrateRules, OneFrameIsFittedButNothingChecksIt) {
  DrawnCalibrationData drawn = draw_small(3, 1);
  disturb(drawn, 0.02, 2 * kDegree, 1);
  const CameraCalibration found = calibrate(drawn.calibration_data).cameras[0];
  EXPECT_TRUE(found.is_found);
  EXPECT_TRUE(std::isnan(found.halves_m));
  EXPECT_GT(found.score_after, found.score_before);
}

TEST(CalibrateRules, ACameraThatALinkCarriesIsFound) {
  // It looks at the arm from beside the first link that turns, and turns with it.
  DrawnCalibrationData drawn = draw_small(2);
  const RobotModel& model = coarse_arm().model;
  CalibrationCamera& camera = *drawn.camera;
  camera.parent = *model.find_link("arm_link_1");
  RobotPose pose;
  forward_kinematics(model, camera.frames[0].joints.position, pose);
  drawn.X_PC_true = pose.X_BL[camera.parent].inverse() * drawn.X_PC_true;
  RobotRenderer renderer(coarse_arm().meshes, camera.camera);
  RobotImage robot;
  for (CalibrationFrame& frame : camera.frames) {
    forward_kinematics(model, frame.joints.position, pose);
    renderer.render(pose, pose.X_BL[camera.parent] * drawn.X_PC_true, robot);
    frame.depth_m = robot.depth_m;
    for (float& z_m : frame.depth_m.pixels()) z_m = std::fmin(z_m, 5.0F);
    sim::add_noise(0.0015, 1, frame.depth_m);
  }
  disturb(drawn, 0.05, 5 * kDegree, 1);
  const CalibrationResult found = calibrate(drawn.calibration_data);
  EXPECT_EQ(found.cameras[0].refused, "");
  // Its points as the camera sees them, at the first pose; at the others they are carried along.
  const Pose X_CC = found.cameras[0].X_PC.inverse() * drawn.X_PC_true;
  const Eigen::Vector3d middle_C_m(0, 0, 1.5);
  EXPECT_LT((X_CC * middle_C_m - middle_C_m).norm(), kWorst_m);
  EXPECT_LT(Eigen::AngleAxisd(X_CC.linear()).angle(), 0.3 * kDegree);
}

/// A room of 6 x 6 x 3 m around the root link, without a robot, from this camera on its way.
DepthImage room_m(const Camera& camera, const Pose& X_BC) {
  const Eigen::Vector3d low(-3, -3, -1);
  const Eigen::Vector3d high(3, 3, 2);
  DepthImage depth_m(camera.width_px, camera.height_px);
  for (int v = 0; v < camera.height_px; ++v) {
    for (int u = 0; u < camera.width_px; ++u) {
      const Eigen::Vector3d ray =
          X_BC.linear() *
          Eigen::Vector3d((u - camera.cx_px) / camera.fx_px, (v - camera.cy_px) / camera.fy_px, 1);
      double z_m = 100;
      for (int i = 0; i < 3; ++i) {
        const double wall_m = (ray[i] > 0 ? high[i] : low[i]) - X_BC.translation()[i];
        if (ray[i] != 0) z_m = std::min(z_m, wall_m / ray[i]);
      }
      depth_m(u, v) = static_cast<float>(z_m);
    }
  }
  return depth_m;
}

DrawnCalibrationData draw_carried(const Arm& arm, sim::DrawnMount mount, int width_px) {
  return arm.draw({.width_px = width_px,
                   .height_px = width_px * 3 / 4,
                   .poses = 5,
                   .moves = true,
                   .mount = mount},
                  1);
}

/// The same way, and nothing of the robot in the images.
void empty_images(DrawnCalibrationData& drawn) {
  RobotPose pose;
  for (std::size_t k = 0; k < drawn.camera->frames.size(); ++k) {
    forward_kinematics(coarse_arm().model, drawn.joints_at_exposure[k], pose);
    drawn.camera->frames[k].depth_m =
        room_m(drawn.camera->camera, pose.X_BL[drawn.camera->parent] * drawn.X_PC_true);
  }
}

TEST(CalibrateRules, ACameraOnTheHandIsFoundByTheRestOfTheArm) {
  for (const auto mount : {sim::DrawnMount::hand, sim::DrawnMount::upper_link}) {
    DrawnCalibrationData drawn = draw_carried(bundled_arm(), mount, 320);
    ASSERT_NE(drawn.camera->parent, 0U);
    disturb(drawn, 0.05, 5 * kDegree, 1);
    const CameraCalibration found = calibrate(drawn.calibration_data).cameras[0];
    EXPECT_EQ(found.refused, "");
    EXPECT_LT(lab::seen_points_apart_m(drawn, found.X_PC, drawn.joint_shift), 0.003);
    EXPECT_NEAR(found.clock_offset_s, 0, 0.003);
  }
}

TEST(CalibrateRules, ACameraOnTheHandThatSeesNothingOfTheRobotIsRefused) {
  // Where the scene has it, the robot should be in view.
  DrawnCalibrationData drawn = draw_carried(coarse_arm(), sim::DrawnMount::hand, 160);
  empty_images(drawn);
  expect_refused(drawn);
}

}  // namespace
}  // namespace berth
