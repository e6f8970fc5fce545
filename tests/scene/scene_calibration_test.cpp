// Which frames a calibration takes, and what it says of those it cannot use.
#include "berth/scene/scene_calibration.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <set>

#include "tests/support/error_message.hpp"
#include "tests/support/temporary_folder.hpp"

namespace berth {
namespace {

const std::string kBundled = BERTH_SOURCE_DIR "/data/bundled/";

/// The bundled arm, with these joint_2 in one row for each image, and those rows' times.
class CalibrationScene : public ::testing::Test {
 protected:
  OpenScene open(const std::vector<double>& joint_2, const std::string& more_camera = "",
                 const std::string& more = "") {
    std::string csv =
        "time,arm_joint_1,arm_joint_2,arm_joint_3,arm_joint_4,arm_joint_5,arm_joint_6,"
        "arm_joint_7\n";
    std::string depth;
    for (std::size_t row = 0; row < joint_2.size(); ++row) {
      csv += fmt::format("{},0.1,{},0.3,-1.5,0,1,0\n", row, joint_2[row]);
      depth += fmt::format("{}\"{}depth/{:06}.png\"", row > 0 ? ", " : "", kBundled, row);
    }
    folder_.write("joints.csv", csv);
    return open_scene(folder_.write(
        "scene.yaml",
        fmt::format("robot: {{urdf: {0}arm/arm.urdf, package_paths: {{berth_arm: {0}arm}}}}\n"
                    "cameras:\n  - name: front\n    info: {0}camera_info.yaml\n"
                    "    pose: {{parent: table, xyz: [0.12, -2.25, 0.8], quaternion_xyzw: "
                    "[-0.788699, 0.0732, -0.05641, 0.607794]}}\n    depth: [{1}]\n{2}"
                    "joints: joints.csv\n{3}",
                    kBundled, depth, more_camera, more)));
  }

  std::string scene_file() const { return (folder_ / "scene.yaml").string(); }

  TemporaryFolder folder_;
};

using Lines = std::vector<std::string>;

TEST_F(CalibrationScene, FivePosesAreGood) {
  const OpenScene scene = open({0, 0.2, 0.4, 0.6, 0.8});
  const SceneCalibrationData material = make_calibration_data(scene);
  EXPECT_EQ(material.warnings, Lines{});
  ASSERT_EQ(material.cameras.size(), 1U);
  ASSERT_EQ(material.calibration_data.cameras.size(), 1U);
  EXPECT_EQ(material.calibration_data.cameras[0], material.cameras[0].get());
  const CalibrationCamera& camera = *material.cameras[0];
  EXPECT_EQ(camera.name, "front");
  EXPECT_EQ(camera.camera.width_px, 640);
  EXPECT_FALSE(camera.has_stamps);
  EXPECT_EQ(material.calibration_data.joints, nullptr);
  ASSERT_EQ(camera.frames.size(), 5U);
  for (int f = 0; f < 5; ++f) {
    EXPECT_EQ(camera.frames[f].number, f);
    EXPECT_NEAR(camera.frames[f].joints.position[1], 0.2 * f, 1e-12);
    EXPECT_EQ(camera.frames[f].depth_m.width(), 640);
  }
}

TEST_F(CalibrationScene, AnArmThatNeverMovesIsRefused) {
  EXPECT_EQ(error_message([&] {
              make_calibration_data(open({0.5, 0.5, 0.505}));
            }),
            scene_file() +
                ": camera front: the arm never moves in its 3 frames; expected five poses that "
                "differ by some tenths of a radian");
  EXPECT_EQ(error_message([&] { make_calibration_data(open({0.5})); }),
            scene_file() +
                ": camera front: the arm never moves in its 1 frame; expected five poses that "
                "differ by some tenths of a radian");
}

TEST_F(CalibrationScene, FramesWithoutJointAnglesAreRefused) {
  OpenScene scene = open({0, 0.5, 1});
  for (FrameTime& time : scene.cameras[0].exposure_time)
    time.status = TimeStatus::extrapolated_too_far;
  EXPECT_EQ(error_message([&] { make_calibration_data(scene); }),
            scene_file() +
                ": camera front: no frame has joint angles; expected five poses of the arm at "
                "least");
}

TEST_F(CalibrationScene, FramesThatAreLeftOutAreCounted) {
  const OpenScene scene = open({0, 0.2, 0.4, 0.6, 0.8, 1}, "    stamps: [0, 1, 2, 3, 4, 100]\n");
  const SceneCalibrationData material = make_calibration_data(scene);
  EXPECT_EQ(material.warnings,
            Lines{"camera front: 1 of 6 frames are not used: there are no joint angles for their "
                  "stamps"});
  EXPECT_EQ(material.cameras[0]->frames.size(), 5U);
  EXPECT_TRUE(material.cameras[0]->has_stamps);
  EXPECT_EQ(material.calibration_data.joints, scene.joints.get());
}

TEST_F(CalibrationScene, FewPosesAreSaid) {
  EXPECT_EQ(make_calibration_data(open({0, 0.5})).warnings,
            Lines{"camera front: only 2 different poses of the arm: the result is not checked by "
                  "other poses; take five or more"});
  // Frames of the same pose are none more.
  EXPECT_EQ(make_calibration_data(open({0, 0.01, 0.5, 0.51, 0.52})).warnings,
            Lines{"camera front: only 2 different poses of the arm: the result is not checked by "
                  "other poses; take five or more"});
  EXPECT_EQ(make_calibration_data(open({0, 0.5, 1, 1})).warnings,
            Lines{"camera front: 3 different poses of the arm; five or more are better"});
}

TEST_F(CalibrationScene, OfManyFramesThoseThatDifferMostAreTaken) {
  // 30 frames on a way, of which the first ones stand.
  std::vector<double> joint_2(30);
  for (std::size_t f = 0; f < joint_2.size(); ++f) joint_2[f] = f < 8 ? 0 : 0.05 * (f - 7);
  const OpenScene scene = open(joint_2);
  const SceneCalibrationData material = make_calibration_data(scene);
  const std::vector<CalibrationFrame>& frames = material.cameras[0]->frames;
  EXPECT_EQ(frames.size(), kMostCalibrationFrames);
  std::set<double> positions;
  for (std::size_t f = 0; f < frames.size(); ++f) {
    EXPECT_TRUE(f == 0 || frames[f].number > frames[f - 1].number) << "in the images' order";
    positions.insert(frames[f].joints.position[1]);
    EXPECT_EQ(frames[f].joints.position[1], joint_2[frames[f].number]);
  }
  EXPECT_EQ(positions.size(), frames.size()) << "none twice";
  EXPECT_EQ(*positions.begin(), 0);
  EXPECT_EQ(*positions.rbegin(), joint_2.back());
}

TEST_F(CalibrationScene, FramesOfOnePoseAreTakenOnce) {
  const OpenScene scene = open({0, 0, 0.5, 0.5, 1, 0});
  const SceneCalibrationData material = make_calibration_data(scene);
  EXPECT_EQ(material.cameras[0]->frames.size(), 3U);
}

TEST_F(CalibrationScene, TheJointsAreThoseAtTheClockThatTheSceneBelieves) {
  const OpenScene scene = open({0, 1, 2}, "    stamps: [0.5, 1, 1.5]\n    clock_offset_s: 0.25\n",
                               "time: {max_skew_s: 0.5}\n");
  const SceneCalibrationData material = make_calibration_data(scene);
  const CalibrationCamera& camera = *material.cameras[0];
  EXPECT_EQ(camera.clock_offset_s, 0.25);
  ASSERT_EQ(camera.frames.size(), 3U);
  EXPECT_NEAR(camera.frames[0].joints.position[1], 0.75, 1e-9);
  EXPECT_NEAR(camera.frames[0].joints.stamp_s, 0.5, 1e-9) << "the camera's own clock";
}

}  // namespace
}  // namespace berth
