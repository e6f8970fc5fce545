#include "berth/scene/scene_file.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "berth/files/camera_info.hpp"
#include "berth/files/joints_csv.hpp"
#include "berth/files/png.hpp"
#include "tests/scene/scene_text.hpp"
#include "tests/support/data_folder.hpp"

namespace berth {
namespace {

namespace fs = std::filesystem;

TEST(Scene, HasEveryFieldOfAFullFile) {
  const TemporaryFolder folder;
  const fs::path file = folder.write("a/scene.yaml", R"(
robot:
  urdf: robot.urdf
  package_paths: {my_description: ../my_description, other: /opt/other}
  geometry: collision
  environment_links: [table, wall]
  ignore_links: [tool]
  srdf: cell.srdf
  allowed_contacts: [[hand, tray], [hand, table]]
  others:
    - {urdf: second.urdf, package_paths: {x: ..}, prefix: second_, pose: {parent: table, xyz: [1, 2, 3], rpy: [0, 0, 0]}}
cameras:
  - name: left
    info: left/info.yaml
    pose: {parent: base_link, xyz: [1.5, 0, 0.8], rpy: [0, 0, 1.5707963267948966]}
    depth: [depth/0.png, /data/1.png]
    depth_scale: 0.0002
    depth_offset_m: -0.003
    stamps: [-0.5, 2]
    near_m: 0.3
    far_m: 4
  - name: right
    info: right.yaml
    pose: {parent: hand, xyz: [0, 0, 0], quaternion_xyzw: [0, 0, 0, 1]}
    depth: [0.png]
joints: joints.csv
self_filter:
  tolerance_m: 0.01
  tolerance_per_m2: 0.03
  padding_m: 0.04
  link_padding_m: {link_3: 0.05, link_4: 0}
  surface_tolerance_m: 0.07
  flying_patch_radius_m: 0.08
sensor:
  speckle_px: 12
  background_frames: 15
evaluation: {range_m: 0.5, mean_direction: off, visibility: false}
time: {max_skew_s: 0.01}
)");
  const SceneFile scene = read_scene(file);
  EXPECT_EQ(scene.file, file);
  EXPECT_EQ(scene.robot.urdf, folder / "a/robot.urdf");
  EXPECT_EQ(scene.robot.package_paths,
            (std::map<std::string, fs::path>{{"my_description", folder / "my_description"},
                                             {"other", "/opt/other"}}));
  EXPECT_EQ(scene.robot.geometry, GeometryKind::collision);
  EXPECT_EQ(scene.robot.environment_links, (std::vector<std::string>{"table", "wall"}));
  EXPECT_EQ(scene.robot.ignore_links, std::vector<std::string>{"tool"});
  EXPECT_EQ(scene.robot.srdf, folder / "a/cell.srdf");
  ASSERT_EQ(scene.robot.allowed_contacts.size(), 2U);
  EXPECT_EQ(scene.robot.allowed_contacts[0], (std::array<std::string, 2>{"hand", "tray"}));
  ASSERT_EQ(scene.robot.others.size(), 1U);
  EXPECT_EQ(scene.robot.others[0].urdf, folder / "a/second.urdf");
  EXPECT_EQ(scene.robot.others[0].package_paths.count("x"), 1U);
  EXPECT_EQ(scene.robot.others[0].prefix, "second_");
  EXPECT_EQ(scene.robot.others[0].parent, "table");
  EXPECT_EQ(scene.robot.others[0].X_PR.translation(), Eigen::Vector3d(1, 2, 3));
  EXPECT_EQ(scene.joints, folder / "a/joints.csv");

  ASSERT_EQ(scene.cameras.size(), 2U);
  const SceneCamera& left = scene.cameras[0];
  EXPECT_EQ(left.name, "left");
  EXPECT_EQ(left.info, folder / "a/left/info.yaml");
  EXPECT_EQ(left.parent_link, "base_link");
  EXPECT_EQ(left.depth, (std::vector<fs::path>{folder / "a/depth/0.png", "/data/1.png"}));
  EXPECT_EQ(left.depth_scale_m, 0.0002);
  EXPECT_EQ(left.depth_offset_m, -0.003);
  EXPECT_EQ(left.stamps_s, (std::vector<double>{-0.5, 2}));
  EXPECT_EQ(left.near_m, 0.3);
  EXPECT_EQ(left.far_m, 4);
  EXPECT_EQ(scene.cameras[1].name, "right");
  EXPECT_EQ(scene.cameras[1].parent_link, "hand");

  const SelfFilterSettings& filter = scene.cameras[0].settings.self_filter;
  EXPECT_EQ(filter.tolerance_m, 0.01);
  EXPECT_EQ(filter.tolerance_per_m2, 0.03);
  EXPECT_EQ(filter.padding_m, 0.04);
  EXPECT_EQ(scene.cameras[0].settings.link_padding_m,
            (std::map<std::string, double>{{"link_3", 0.05}, {"link_4", 0}}));
  EXPECT_EQ(filter.surface_tolerance_m, 0.07);
  EXPECT_EQ(filter.flying_patch_radius_m, 0.08);
  const SensorSettings& sensor = scene.cameras[0].settings.sensor;
  EXPECT_EQ(sensor.speckle_px, 12);
  EXPECT_EQ(sensor.background_frames, 15);
  EXPECT_EQ(scene.evaluation.distance.range_m, 0.5);
  EXPECT_EQ(scene.evaluation.distance.mean_direction, false);
  EXPECT_EQ(scene.evaluation.visibility, false);
  EXPECT_EQ(scene.evaluation.time.joints.max_skew_s, 0.01);
}

TEST(Scene, LeavesDefaultsToThoseWhoOwnThem) {
  const SceneFile scene = read_text(with(&SceneText::more_camera, ""));
  EXPECT_EQ(scene.robot.geometry, GeometryKind::visual);
  EXPECT_TRUE(scene.robot.package_paths.empty());
  EXPECT_EQ(scene.cameras[0].depth_scale_m, 0.001);
  EXPECT_EQ(scene.cameras[0].depth_offset_m, 0);
  EXPECT_TRUE(scene.cameras[0].stamps_s.empty());
  EXPECT_EQ(scene.cameras[0].near_m, 0);
  EXPECT_EQ(scene.cameras[0].far_m, std::numeric_limits<double>::infinity());
  const CameraSettings usual;
  const EvaluationSettings evaluation;
  EXPECT_EQ(scene.cameras[0].settings.self_filter.tolerance_m, usual.self_filter.tolerance_m);
  EXPECT_TRUE(scene.cameras[0].settings.link_padding_m.empty());
  EXPECT_EQ(scene.cameras[0].settings.sensor.speckle_px, usual.sensor.speckle_px);
  EXPECT_EQ(scene.evaluation.distance.range_m, evaluation.distance.range_m);
  EXPECT_EQ(scene.evaluation.distance.mean_direction, evaluation.distance.mean_direction);
  EXPECT_EQ(scene.evaluation.visibility, evaluation.visibility);
  EXPECT_EQ(scene.evaluation.time.joints.max_skew_s, kInRecordings.max_skew_s);
}

TEST(Scene, AQuaternionAndTheOneOfTheOtherSignAreOneRotation) {
  const std::string pose = "pose: {parent: base, xyz: [1, 2, 3], quaternion_xyzw: ";
  const SceneFile plus = read_text(with(&SceneText::pose, pose + "[0.1, -0.5, 0.7, 0.5]}"));
  const SceneFile minus = read_text(with(&SceneText::pose, pose + "[-0.1, 0.5, -0.7, -0.5]}"));
  EXPECT_TRUE(plus.cameras[0].X_PC.isApprox(minus.cameras[0].X_PC, 1e-15));
}

TEST(Scene, PoseOfTheCameraTurnsAndMovesAsWritten) {
  const SceneFile scene = read_text(with(
      &SceneText::pose,
      "pose: {parent: base, xyz: [1, 2, 3], quaternion_xyzw: [0, 0, 0.70710678, 0.70710678]}"));
  const Pose& X_PC = scene.cameras[0].X_PC;
  EXPECT_TRUE((X_PC * Eigen::Vector3d(1, 0, 0)).isApprox(Eigen::Vector3d(1, 3, 3), 1e-12));
  EXPECT_TRUE((X_PC.linear() * X_PC.linear().transpose()).isIdentity(1e-14));
}

TEST(Scene, RpyTurnsAboutTheFixedAxesXThenYThenZ) {
  const SceneFile scene = read_text(with(
      &SceneText::pose,
      "pose: {parent: base, xyz: [0, 0, 0], rpy: [1.5707963267948966, 0, 1.5707963267948966]}"));
  // z goes to -y by the roll, and that to x by the yaw.
  EXPECT_TRUE(
      (scene.cameras[0].X_PC * Eigen::Vector3d(0, 0, 1)).isApprox(Eigen::Vector3d(1, 0, 0), 1e-12));
  const SceneFile pitched = read_text(
      with(&SceneText::pose, "pose: {parent: base, xyz: [0, 0, 0], rpy: [0.1, 0.2, 0.3]}"));
  const Eigen::Matrix3d R = pitched.cameras[0].X_PC.linear();
  EXPECT_NEAR(std::atan2(R(2, 1), R(2, 2)), 0.1, 1e-12);
  EXPECT_NEAR(std::asin(-R(2, 0)), 0.2, 1e-12);
  EXPECT_NEAR(std::atan2(R(1, 0), R(0, 0)), 0.3, 1e-12);
}

TEST(Scene, DepthPatternGivesTheFilesInTheOrderOfTheirNumbers) {
  const TemporaryFolder folder;
  for (const char* name : {"d[1]/10.png", "d[1]/9.png", "d[1]/100.png", "d[1]/9.txt"})
    folder.write(name, "");
  const fs::path file =
      folder.write("d[1]/scene.yaml", with(&SceneText::depth, "depth: '*.png'").text());
  EXPECT_EQ(read_scene(file).cameras[0].depth,
            (std::vector<fs::path>{folder / "d[1]/9.png", folder / "d[1]/10.png",
                                   folder / "d[1]/100.png"}));
  for (const char* name : {"e/000009.png", "e/000010.png", "e/000100.png"}) folder.write(name, "");
  const std::string absolute = "depth: " + (folder / "e").string() + "/*.png";
  folder.write("d[1]/scene.yaml", with(&SceneText::depth, absolute).text());
  EXPECT_EQ(read_scene(file).cameras[0].depth,
            (std::vector<fs::path>{folder / "e/000009.png", folder / "e/000010.png",
                                   folder / "e/000100.png"}));
}

/// Somebody's real recordings, where they are.
TEST(Scene, TheRealRecordingsCanBeReadWhole) {
  const fs::path recordings = data_folder() / "recordings";
  if (!fs::exists(recordings)) GTEST_SKIP() << recordings << " is missing; set BERTH_DATA";
  for (const char* name : {"xarm7_realsense", "lbr_med7_zed2i"}) {
    const SceneFile scene = read_scene(recordings / name / "scene.yaml");
    EXPECT_TRUE(fs::exists(scene.robot.urdf)) << scene.robot.urdf;
    for (const auto& [package, folder] : scene.robot.package_paths)
      EXPECT_TRUE(fs::exists(folder)) << folder;
    const SceneCamera& scene_camera = scene.cameras.at(0);
    const Camera camera = read_camera_info(scene_camera.info).camera;
    EXPECT_EQ(read_joints_csv(scene.joints).rows.size(), scene_camera.depth.size());
    for (const fs::path& image : scene_camera.depth) {
      const DepthImage depth_m = read_depth_png(image, camera, scene_camera.depth_scale_m);
      EXPECT_EQ(depth_m.width(), camera.width_px);
    }
  }
}

}  // namespace
}  // namespace berth
