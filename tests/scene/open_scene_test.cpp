// The joints of a scene: columns of its CSV file, offsets, and positions that are fixed.
#include "berth/scene/open_scene.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "berth/files/png.hpp"
#include "berth/robot/primitives.hpp"
#include "berth/scene/camera_frames.hpp"
#include "tests/support/error_message.hpp"
#include "tests/support/same_bits.hpp"
#include "tests/support/temporary_folder.hpp"

namespace berth {
namespace {

constexpr const char* kSevenColumns =
    "time,arm_joint_1,arm_joint_2,arm_joint_3,arm_joint_4,arm_joint_5,arm_joint_6,arm_joint_7\n"
    "0,0.1,0.2,0.3,0.4,0.5,0.6,0.7\n";
constexpr const char* kFiveColumns =
    "time,arm_joint_2,arm_joint_1,arm_joint_3,arm_joint_4,arm_joint_6\n"
    "0,0.2,0.1,0.3,0.4,0.6\n";

/// The bundled arm with these joints and more lines of the scene file; one image.
OpenScene open_with(const std::string& joints_csv, const std::string& lines) {
  const TemporaryFolder folder;
  const std::string bundled = BERTH_SOURCE_DIR "/data/bundled/";
  folder.write("joints.csv", joints_csv);
  return open_scene(folder.write(
      "scene.yaml",
      "robot: {urdf: " + bundled + "arm/arm.urdf, package_paths: {berth_arm: " + bundled +
          "arm}}\ncameras:\n  - name: camera\n    info: " + bundled +
          "camera_info.yaml\n    pose: {parent: table, xyz: [0, 0, 0], rpy: [0, 0, 0]}\n    "
          "depth: [" +
          bundled + "depth/000000.png]\njoints: joints.csv\n" + lines + "\n"));
}

std::vector<double> position_of(const OpenScene& scene) {
  return scene.cameras.front().at_exposure.front().position;
}

TEST(SceneJoints, FixedOnesAreAsIfTheyHadAColumn) {
  const OpenScene scene =
      open_with(kFiveColumns, "fixed_joints: {arm_joint_7: 0.7, arm_joint_5: 0.5}");
  EXPECT_EQ(position_of(scene), position_of(open_with(kSevenColumns, "")));
}

TEST(SceneJoints, OffsetsAreAddedToColumns) {
  const auto plain = position_of(open_with(kSevenColumns, ""));
  auto moved = position_of(open_with(kSevenColumns, "joint_offsets: {arm_joint_2: 0.25}"));
  EXPECT_EQ(moved[1], plain[1] + 0.25);
  moved[1] = plain[1];
  EXPECT_EQ(moved, plain);
}

TEST(SceneJoints, AJointThatIsMissingTwiceOrUnknownIsNamed) {
  const auto message = [](const char* joints_csv, const std::string& lines) {
    return error_message([&] { open_with(joints_csv, lines); });
  };
  expect_parts(
      message(kFiveColumns, "fixed_joints: {arm_joint_5: 0.5}"),
      {"joints.csv: joint \"arm_joint_7\"", "is missing", "an entry in the scene's fixed_joints"});
  expect_parts(message(kSevenColumns, "fixed_joints: {arm_joint_7: 0.7}"),
               {"scene.yaml: fixed_joints.arm_joint_7: ",
                "joints.csv has a column of this joint too; expected one of both"});
  expect_parts(message(kSevenColumns, "fixed_joints: {arm_jont_6: 0}"),
               {"scene.yaml: fixed_joints.arm_jont_6: no joint of robot",
                "expected arm_joint_6 (the nearest), or another of arm_joint_1, arm_joint_2"});
  expect_parts(message(kSevenColumns, "fixed_joints: {arm_joint_7: .nan}"),
               {"scene.yaml:8: fixed_joints.arm_joint_7: .nan; expected a finite number"});
  expect_parts(message(kFiveColumns, "joint_offsets: {arm_joint_7: 0.7}"),
               {"scene.yaml: joint_offsets.arm_joint_7: ", "joints.csv has no such joint"});
}

TEST(SceneCameras, ReadTheirImagesInTheirUnitsAndWithinTheirLimits) {
  const auto pixels_of = [](double unit_m, double near_m, double far_m) {
    SceneFile file = read_scene(BERTH_SOURCE_DIR "/data/bundled/one_camera.yaml");
    file.cameras[0].depth_scale_m = unit_m;
    file.cameras[0].near_m = near_m;
    file.cameras[0].far_m = far_m;
    return open_scene(file).cameras[0].read_depth(0).pixels();
  };
  const std::vector<float> all_m = pixels_of(0.001, 0, 1000);
  const std::vector<float> limited_m = pixels_of(0.0005, 0.6, 1);
  int kept = 0, dropped = 0;
  for (std::size_t i = 0; i < all_m.size(); ++i) {
    const double half_m = 0.5 * all_m[i];
    if (std::isnan(limited_m[i])) {
      EXPECT_FALSE(half_m > 0.6001 && half_m < 0.9999) << half_m;
      dropped += !std::isnan(half_m);
    } else {
      EXPECT_NEAR(limited_m[i], half_m, 1e-6);
      EXPECT_TRUE(half_m > 0.5999 && half_m < 1.0001) << half_m;
      ++kept;
    }
  }
  EXPECT_GT(kept, 1000);
  EXPECT_GT(dropped, 1000);
}

SceneFile bundled_file() { return read_scene(BERTH_SOURCE_DIR "/data/bundled/one_camera.yaml"); }

/// The bundled camera's image as other cameras would give it.
struct OtherCamera {
  OtherCamera(const std::string& info, std::string more) : keys(std::move(more)) {
    folder.write("info.yaml", info);
  }
  OpenScene open(const DepthImage& depth_m) const {
    write_depth_png(folder / "other.png", depth_m, 0.001);
    const std::string bundled = BERTH_SOURCE_DIR "/data/bundled/";
    folder.write("joints.csv", kSevenColumns);
    return open_scene(folder.write(
        "scene.yaml", "robot: {urdf: " + bundled + "arm/arm.urdf, package_paths: {berth_arm: " +
                          bundled + "arm}}\ncameras:\n  - name: camera\n    info: info.yaml\n    " +
                          "pose: {parent: table, xyz: [0, 0, 0], rpy: [0, 0, 0]}\n    " +
                          "depth: [other.png]\n    " + keys + "\njoints: joints.csv\n"));
  }
  TemporaryFolder folder;
  std::string keys;
};

const Camera kOther{160, 120, 120, 120, 80, 60};
const std::string kOtherInfo =
    "image_width: 160\nimage_height: 120\ncamera_matrix: {data: [120, 0, 80, 0, 120, 60, 0, 0, "
    "1]}\ndistortion_model: plumb_bob\ndistortion_coefficients: {data: ";

TEST(SceneCameras, ReadDistancesAlongTheRay) {
  const OtherCamera camera(kOtherInfo + "[]}\n", "depth_is: ray");
  DepthImage given_m(160, 120);
  for (int v = 0; v < 120; ++v) {
    for (int u = 0; u < 160; ++u) given_m(u, v) = point_at(kOther, u, v, 2).norm();
  }
  const DepthImage read_m = camera.open(given_m).cameras[0].read_depth(0);
  for (const float z_m : read_m.pixels()) EXPECT_NEAR(z_m, 2, 0.001);
}

TEST(SceneCameras, RectifyWhatALensBends) {
  const OtherCamera camera(kOtherInfo + "[-0.3, 0.1, 0, 0, 0]}\n", "rectified: false");
  DepthImage given_m(160, 120, 3);
  given_m(150, 60) = 1;
  const OpenScene scene = camera.open(given_m);
  const OpenCamera& open = scene.cameras[0];
  EXPECT_EQ(open.given().width_px, 160);
  EXPECT_GT(open.mounted->camera().width_px, 170);
  const DepthImage read_m = open.read_depth(0);
  ASSERT_EQ(read_m.width(), open.mounted->camera().width_px);
  // 70 pixels to the right of the middle: 0.583 = x (1 - 0.3 x^2 + 0.1 x^4).
  const auto at = pixel_of(open.mounted->camera(), Eigen::Vector3d(0.6556, 0, 1));
  ASSERT_TRUE(at);
  EXPECT_NEAR(read_m(at->u, at->v), 1, 0.001);
}

TEST(SceneCameras, WhoeverHasDistortionHasToSayWhetherItIsLeft) {
  expect_parts(
      error_message([] { OtherCamera(kOtherInfo + "[0.1]}\n", "").open(DepthImage(160, 120, 1)); }),
      {"info.yaml:5", "rectified: true"});
  const OtherCamera rectified(kOtherInfo + "[0.1]}\n", "rectified: true");
  EXPECT_EQ(rectified.open(DepthImage(160, 120, 1)).cameras[0].mounted->camera().width_px, 160);
}

TEST(SceneCameras, WithoutStampsEachImageHasItsRow) {
  const std::string still = std::string(kSevenColumns) + "1,0.1,0.2,0.3,0.4,0.5,0.6,0.7\n";
  EXPECT_EQ(open_with(still, "").joints->size(), 2U);
  const std::string rows = still + "2,0.1,0.9,0.3,0.4,0.5,0.6,0.7\n";
  expect_parts(error_message([&] { open_with(rows, ""); }),
               {"joints.csv: 3 rows", "the 1 images of camera camera", "or stamps"});
}

TEST(SceneCameras, RowsInMillisecondsAreNamed) {
  SceneFile file = read_scene(BERTH_SOURCE_DIR "/data/bundled/one_camera.yaml");
  const TemporaryFolder folder;
  std::string rows =
      "time,arm_joint_1,arm_joint_2,arm_joint_3,arm_joint_4,arm_joint_5,arm_joint_6,"
      "arm_joint_7\n";
  for (int i = 0; i < 20; ++i) rows += std::to_string(10 * i) + ",0,0,0,0,0,0,0\n";
  file.joints = folder.write("joints.csv", rows);
  expect_parts(error_message([&] { open_scene(file); }),
               {"joints.csv: rows of joint angles are 10 s apart", "images of camera camera",
                "expected both in seconds"});
}

TEST(SceneCameras, TimesAreInSeconds) {
  expect_parts(error_message([] { open_with("time,arm_joint_1\n1700000000000,0\n", ""); }),
               {"joints.csv:2: time: 1700000000000; expected seconds"});
}

TEST(SceneCameras, KeepNoImageUnlessAskedTo) {
  const OpenScene scene = open_scene(bundled_file());
  const OpenScene keeping = open_scene_with_images(bundled_file());
  for (std::size_t k = 0; k < scene.frame_count; ++k) {
    EXPECT_EQ(scene.cameras[0].kept_depth_m[k], nullptr);
    ASSERT_NE(keeping.cameras[0].kept_depth_m[k], nullptr);
  }
  EXPECT_TRUE(same_bits(scene.cameras[0].read_depth(3), keeping.cameras[0].read_depth(3)));
}

TEST(BackgroundOfALongRecording, IsLearnedFromRunsOfImagesThatLieEvenlyOverIt) {
  OpenCamera camera = open_scene(bundled_file()).cameras[0];
  const auto images_of = [&](std::size_t count, int background_frames) {
    camera.source.depth.resize(count);
    CameraSettings settings = camera.mounted->settings();
    settings.sensor.background_frames = background_frames;
    camera.mounted = std::make_shared<const MountedCamera>(camera.mounted->robot(),
                                                           camera.mounted->mount(), settings);
    std::size_t images = 0, next = 0;
    for (const ImageRun& run : images_to_learn_from(camera)) {
      EXPECT_GE(run.first, next);
      // No part of the recording is left out.
      EXPECT_LE(run.first, next + count / 10);
      images += run.count;
      next = run.first + run.count;
    }
    EXPECT_EQ(next, count);
    return images;
  };
  EXPECT_EQ(images_of(36, 3), 36);
  EXPECT_EQ(images_of(256, 3), 256);
  EXPECT_EQ(images_of(257, 3), 256);
  EXPECT_EQ(images_of(10'000, 3), 256);
  EXPECT_EQ(images_of(10'000, 100), 800);
}

TEST(ReopenedScene, SharesRobotAndImages) {
  const OpenScene before = open_scene_with_images(bundled_file());
  SceneFile changed = bundled_file();
  changed.cameras[0].settings.self_filter.padding_m = 0.05;
  changed.cameras[0].X_PC.translation().x() += 0.1;
  const OpenScene scene = reopen_scene(before, changed);
  EXPECT_EQ(scene.robot, before.robot);
  EXPECT_EQ(scene.frame_count, before.frame_count);
  EXPECT_EQ(scene.cameras[0].kept_depth_m, before.cameras[0].kept_depth_m);
  EXPECT_EQ(scene.cameras[0].mounted->settings().self_filter.padding_m, 0.05);
  EXPECT_EQ(scene.cameras[0].mounted->mount().X_PC.translation(),
            changed.cameras[0].X_PC.translation());
}

TEST(ReopenedScene, IsThatOfTheChangedFile) {
  SceneFile changed = bundled_file();
  changed.evaluation.distance.range_m = 0.5;
  changed.cameras[0].clock_offset_s = 0.01;
  changed.joint_offsets = {{"arm_joint_2", 0.25}};
  const OpenScene scene = reopen_scene(open_scene(bundled_file()), changed);
  const OpenScene expected = open_scene(changed);
  EXPECT_EQ(scene.robot->settings(), expected.robot->settings());
  EXPECT_EQ(position_of(scene), position_of(expected));
  EXPECT_EQ(scene.joint_offsets, expected.joint_offsets);
}

TEST(ReopenedScene, CarriesWhatItIsToldTo) {
  SceneFile file = bundled_file();
  SceneAttachment& box = file.attached.emplace_back();
  box.link = "arm_link_3";
  box.name = "box";
  box.box_m = {0.1, 0.1, 0.1};
  const OpenScene before = open_scene(file);
  const std::vector<Attachment> carried = {
      {"ball", "arm_link_7", make_sphere(0.05), Pose::Identity(), true}};
  const OpenScene carries = reopen_scene(before, file, carried);
  const auto names = [](const OpenScene& scene) {
    std::vector<std::string> all;
    for (const Attachment& one : scene.robot->attached()) all.push_back(one.name);
    return all;
  };
  EXPECT_EQ(names(carries), (std::vector<std::string>{"box", "ball"}));
  EXPECT_TRUE(carries.robot->model().find_link("ball"));
  EXPECT_EQ(carries.cameras[0].mounted->robot(), carries.robot);
  EXPECT_EQ(reopen_scene(carries, file, carried).robot, carries.robot);
  EXPECT_EQ(names(reopen_scene(carries, file)), std::vector<std::string>{"box"});
}

TEST(OpenedScene, HasWhatIsSoftAsNoLink) {
  const std::string lines = "attached: [{link: arm_link_7, name: hose, sphere: 0.1, soft: true}]\n";
  const OpenScene scene = open_with(kSevenColumns, lines);
  ASSERT_EQ(scene.robot->attached().size(), 1U);
  EXPECT_TRUE(scene.robot->attached()[0].is_soft);
  EXPECT_FALSE(scene.robot->model().find_link("hose"));
  ASSERT_EQ(scene.robot->model().soft_bodies.size(), 1U);
  EXPECT_EQ(scene.robot->model().soft_bodies[0].link(),
            *scene.robot->model().find_link("arm_link_7"));
}

TEST(OpenedScene, HasWhatAPartMayTouch) {
  const std::string lines =
      "attached: [{link: arm_link_7, name: part, sphere: 0.1, may_touch: [table]}]\n";
  const OpenScene scene = open_with(kSevenColumns, lines);
  EXPECT_EQ(scene.robot->attached()[0].may_touch, std::vector<std::string>{"table"});
  ASSERT_EQ(scene.robot->model().allowed_contacts.size(), 1U);
  EXPECT_EQ(scene.robot->model().allowed_contacts[0].other, "table");
}

TEST(ReopenedScene, RefusesWhatAnOpenedOneDoes) {
  const OpenScene before = open_scene(bundled_file());
  SceneFile changed = bundled_file();
  changed.cameras[0].settings.self_filter.padding_m = -1;
  expect_parts(error_message([&] { reopen_scene(before, changed); }),
               {"one_camera.yaml", "padding_m: -1", "expected"});
}

}  // namespace
}  // namespace berth
