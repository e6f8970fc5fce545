// From a scene on disk to the changes of its file.
#include "berth/scene/calibrate_scene.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/coarse_arm.hpp"
#include "tests/support/drawn_cell.hpp"
#include "tests/support/error_message.hpp"

namespace berth {
namespace {

using testing::CellLines;
using testing::DrawnCell;

const std::filesystem::path& kArm =
    testing::coarse_arm_folder(BERTH_SOURCE_DIR "/data/bundled/arm");
constexpr sim::DrawnCalibrationSettings kSmall{.width_px = 320, .height_px = 240, .poses = 4};

/// A cell with what calibration says of it.
struct Calibrated {
  DrawnCell cell;
  OpenScene scene;
  SceneCalibrationData material;
  SceneCalibration calibration;

  Calibrated(const sim::DrawnCalibrationSettings& drawn, std::uint32_t seed, const CellLines& lines,
             const CalibrateSceneSettings& settings = {})
      : cell(kArm, drawn, seed, lines),
        scene(open_scene(cell.scene())),
        material(make_calibration_data(scene)),
        calibration(calibrate_scene(scene, material, settings)) {}

  SceneFile rewritten() const {
    write_rewritten_scene(cell.scene(), calibration.change, cell / "new.yaml");
    return read_scene(cell / "new.yaml");
  }
  const SceneCameraChange& change() const { return calibration.change.cameras.at(0); }
};

TEST(CalibrateScene, TheNewSceneHasPoseSettingsAndWatch) {
  const Calibrated calibrated(kSmall, 2, {});
  const CameraCalibration& found = calibrated.calibration.found.cameras[0];
  ASSERT_EQ(found.refused, "");
  EXPECT_LT((found.X_PC.translation() - calibrated.cell.drawn.X_PC_true.translation()).norm(),
            0.02);
  const SceneFile scene = calibrated.rewritten();
  const SceneCamera& camera = scene.cameras[0];
  EXPECT_TRUE(camera.X_PC.isApprox(found.X_PC, 1e-8));
  EXPECT_EQ(camera.depth_scale_m, 0.001) << "nobody asked for a correction";
  EXPECT_EQ(camera.depth_offset_m, 0);
  EXPECT_EQ(camera.clock_offset_s, 0);
  EXPECT_TRUE(scene.joint_offsets.empty());
  const FilterProposal& filter = calibrated.calibration.filters.at(0);
  ASSERT_EQ(filter.self_filter.size(), 3U);
  EXPECT_EQ(camera.settings.self_filter.tolerance_m, filter.self_filter[0].value);
  EXPECT_EQ(camera.settings.self_filter.padding_m, filter.self_filter[1].value);
  EXPECT_EQ(camera.settings.self_filter.surface_tolerance_m, filter.self_filter[2].value);
  const WatchSettings& watch = camera.settings.watch;
  EXPECT_TRUE(watch.is_on());
  EXPECT_GE(watch.max_seen_through, 0.03);
  EXPECT_LT(watch.max_seen_through, 0.2);
  EXPECT_GE(watch.max_displacement_m, 0.008);
  EXPECT_LT(watch.max_displacement_m, 0.05);
  EXPECT_NEAR(watch.bias_m, filter.bias_m, 5e-4);
  EXPECT_NO_THROW(open_scene(scene));
  EXPECT_EQ(calibrated.calibration.warnings,
            std::vector<std::string>{
                "camera camera: 4 different poses of the arm; five or more are better"});
  EXPECT_FALSE(calibrated.calibration.detection.empty());
  EXPECT_TRUE(calibrated.calibration.change.values.empty()) << "it has no monitor to be told";
}

TEST(CalibrateScene, TheMonitorIsToldWhatIsDetected) {
  const Calibrated calibrated(kSmall, 2, {.more = "separation: {detection_m: 0.04}\n"});
  const double worst_m = calibrated.calibration.detection.cell.worst_m();
  ASSERT_GT(worst_m, 0.04) << "else it would stay";
  ASSERT_LE(worst_m, 0.08);
  EXPECT_EQ(calibrated.rewritten().separation->detection_m, worst_m);
  expect_parts(calibrated.calibration.warnings.back(),
               {"separation.detection_m: 0.04 becomes", "was 0.21 m and becomes 0.85 m"});
}

TEST(CalibrateScene, JointOffsetsAreAddedToOldOnes) {
  constexpr double kOld = 0.02;
  sim::DrawnCalibrationSettings settings = kSmall;
  settings.poses = 8;
  settings.width_px = 640;
  settings.height_px = 480;
  // joints.csv is right, so that the offset is wrong.
  Calibrated calibrated(settings, 1,
                        {.offset_m = 0.01,
                         .angle_rad = 0.01,
                         .more = "joint_offsets: {arm_joint_2: 0.02, arm_joint_1: 0.0}\n"},
                        {.fit = {.joint_zeros = true}});
  const auto& found = calibrated.calibration.found.joint_offsets;
  const auto& changed = calibrated.calibration.change.joint_offsets;
  EXPECT_EQ(changed.size(), found.size());
  for (const auto& [joint, offset] : found) {
    const double old = joint == "arm_joint_2" ? kOld : 0;
    EXPECT_EQ(changed.at(joint), offset + old) << joint;
  }
  ASSERT_EQ(found.count("arm_joint_2"), 1U);
  EXPECT_NEAR(found.at("arm_joint_2"), -kOld, 0.005);
  const SceneFile scene = calibrated.rewritten();
  EXPECT_NEAR(scene.joint_offsets.at("arm_joint_2"), 0, 0.005);
  EXPECT_EQ(scene.joint_offsets.count("arm_joint_1"), 1U) << "it was not told, and stays";
  EXPECT_EQ(scene.joint_offsets.at("arm_joint_1"), 0);
}

TEST(CalibrateScene, ACorrectedDepthIsWhatTheNewSceneReads) {
  sim::DrawnCalibrationSettings settings = kSmall;
  settings.errors.depth_share = 0.02;
  const Calibrated calibrated(settings, 2, {.depth_scale_m = 0.0005, .depth_offset_m = 0.1},
                              {.fit = {}, .correct_depth = true});
  const CameraCalibration& found = calibrated.calibration.found.cameras[0];
  ASSERT_EQ(found.refused, "");
  ASSERT_NE(found.depth.scale, 1);
  const OpenScene corrected = open_scene(calibrated.rewritten());
  const DepthImage before = calibrated.scene.cameras[0].read_depth(1);
  const DepthImage after = corrected.cameras[0].read_depth(1);
  double farthest_m = 0;
  double share_sum = 0;
  int count = 0;
  for (std::size_t i = 0; i < before.pixels().size(); ++i) {
    const double z_m = before.pixels()[i];
    ASSERT_EQ(std::isnan(after.pixels()[i]), std::isnan(z_m));
    if (std::isnan(z_m)) continue;
    const double expected_m = found.depth.offset_m + found.depth.scale * z_m;
    farthest_m = std::max(farthest_m, std::abs(after.pixels()[i] - expected_m));
    share_sum += after.pixels()[i] / z_m;
    ++count;
  }
  EXPECT_LT(farthest_m, 1e-5);
  ASSERT_GT(count, 1000);
  EXPECT_NEAR(share_sum / count, 1 / 1.02, 0.01) << "the truth";
  // The watch and the filter are those of corrected readings.
  EXPECT_LT(std::abs(calibrated.calibration.filters[0].bias_m), 0.005);
}

TEST(CalibrateScene, WhatMovedBesideTheRobotIsSaid) {
  DrawnCell cell(kArm, {.width_px = 320, .height_px = 240}, 2, {});
  DepthImage depth_m = cell.drawn.camera->frames[3].depth_m;
  for (int v = 0; v < depth_m.height(); ++v) {
    for (int u = 0; u < depth_m.width() / 5; ++u) depth_m(u, v) = 0.6F;
  }
  write_depth_png(cell / "cell/depth/000003.png", depth_m, 0.001);
  const OpenScene scene = open_scene(cell.scene());
  const SceneCalibrationData material = make_calibration_data(scene);
  const SceneCalibration calibration = calibrate_scene(scene, material, {});
  ASSERT_EQ(calibration.warnings.size(), 1U);
  expect_parts(calibration.warnings[0],
               {"camera camera: something beside the robot moved, most of all between frames ",
                " % of what is seen there); expected fixed things alone"});
  EXPECT_TRUE(calibration.warnings[0].find("frames 2 and 3") != std::string::npos ||
              calibration.warnings[0].find("frames 3 and 4") != std::string::npos)
      << calibration.warnings[0];
}

TEST(CalibrateScene, ACameraWhoseImagesNoPoseExplainsIsRefused) {
  DrawnCell cell(kArm, {.width_px = 160, .height_px = 120, .poses = 3}, 2, {});
  for (int f = 0; f < 3; ++f) {
    write_depth_png(cell / fmt::format("cell/depth/{:06}.png", f), DepthImage(160, 120, 2.5F),
                    0.001);
  }
  const OpenScene scene = open_scene(cell.scene());
  const SceneCalibrationData material = make_calibration_data(scene);
  expect_parts(error_message([&] { calibrate_scene(scene, material, {}); }),
               {cell.scene().string() + ": camera camera: the camera is dead: ",
                "all readings of its images are the same, 2.5 m"});
}

TEST(CalibrateScene, APauseThatThrowsStopsIt) {
  const DrawnCell cell(kArm, {.width_px = 160, .height_px = 120, .poses = 3}, 2, {});
  const OpenScene scene = open_scene(cell.scene());
  const SceneCalibrationData material = make_calibration_data(scene);
  CalibrateSceneSettings settings;
  settings.fit.pause = [] { throw std::runtime_error("stopped"); };
  EXPECT_EQ(error_message([&] { calibrate_scene(scene, material, settings); }), "stopped");
}

}  // namespace
}  // namespace berth
