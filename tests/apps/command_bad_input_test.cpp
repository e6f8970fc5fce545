// A bad input gives exit status 1, a message with file, place, value and what was expected, and
// neither output nor files: some of each kind. All that is refused is tested beside its reader.
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <functional>
#include <utility>

#include "berth/files/file_bytes.hpp"
#include "berth/files/png.hpp"
#include "tests/apps/refusal.hpp"

namespace berth {
namespace {

namespace fs = std::filesystem;

struct BadInput {
  std::string name;
  std::function<void(CommandScene&)> spoil;
  /// Parts of the message: file, place, value, what was expected.
  std::vector<std::string> told;
};

/// What a test of it is called.
void PrintTo(const BadInput& input, std::ostream* out) { *out << input.name; }

class BadScene : public ::testing::TestWithParam<BadInput> {};

TEST_P(BadScene, IsRefusedByRunAndFilter) {
  CommandScene scene;
  GetParam().spoil(scene);
  expect_refused(scene, {"run", "scene.yaml", "--out", "result.txt", "--picture", "pictures"},
                 GetParam().told);
  expect_refused(scene, {"filter", "scene.yaml", "--out", "filtered"}, GetParam().told);
}

std::string name_of_case(const ::testing::TestParamInfo<BadInput>& info) { return info.param.name; }

using S = CommandScene;

std::function<void(S&)> write(const std::string& name, const std::string& bytes) {
  return [=](S& s) { s.write(name, bytes); };
}

std::function<void(S&)> remove_file(const std::string& name) {
  return [=](S& s) { fs::remove(s / name); };
}

std::function<void(S&)> set(std::string SceneLines::*line, const std::string& text) {
  return [=](S& s) { s.lines.*line = text; };
}

std::function<void(S&)> cut_image(const std::string& name) {
  return [=](S& s) {
    const std::string bytes = read_file_bytes(s / name);
    s.write(name, bytes.substr(0, bytes.size() / 2));
  };
}

std::function<void(S&)> pipe(const std::string& name) {
  return [=](S& s) {
    fs::remove(s / name);
    EXPECT_EQ(::mkfifo((s / name).c_str(), 0600), 0);
  };
}

std::vector<BadInput> pipes() {
  std::vector<BadInput> inputs;
  for (const auto& [label, file] :
       {std::pair("DepthImage", "depth/000000.png"), std::pair("CameraInfo", "camera_info.yaml"),
        std::pair("Joints", "joints.csv"), std::pair("Robot", "arm.urdf"),
        std::pair("Mesh", "parts/lower.stl")}) {
    inputs.push_back({std::string(label) + "IsAPipe",
                      pipe(file),
                      {std::string(file) + ": is a pipe or device; expected a regular file"}});
  }
  return inputs;
}

INSTANTIATE_TEST_SUITE_P(NoFile, BadScene, ::testing::ValuesIn(pipes()), name_of_case);

INSTANTIATE_TEST_SUITE_P(
    NamesNoFile, BadScene,
    ::testing::Values(
        BadInput{"Robot",
                 remove_file("arm.urdf"),
                 {"scene.yaml: robot.urdf: arm.urdf: No such file or directory; expected a "
                  "readable file, its path relative to the scene's folder"}},
        BadInput{"CameraInfo",
                 remove_file("camera_info.yaml"),
                 {"scene.yaml: cameras[0].info: camera_info.yaml: No such file"}},
        BadInput{
            "Joints", remove_file("joints.csv"), {"scene.yaml: joints: joints.csv: No such file"}},
        BadInput{"Background",
                 [](S& s) {
                   s.lines.more_camera = "background: gone.png";
                   s.lines.more = "sensor: {background_frames: 1}";
                 },
                 {"scene.yaml: cameras[0].background: gone.png: No such file"}}),
    name_of_case);

INSTANTIATE_TEST_SUITE_P(
    DepthImage, BadScene,
    ::testing::Values(
        BadInput{"Missing", remove_file("depth/000000.png"), {"depth/000000.png", "expected"}},
        BadInput{
            "OfAnotherSize",
            [](S& s) { write_depth_png(s / "depth/000000.png", DepthImage(32, 48, 2), 0.001); },
            {"depth/000000.png", "32 x 48", "expected", "64 x 48"}},
        BadInput{"LastOfSeveral",
                 cut_image("depth/000002.png"),
                 {"depth/000002.png", "expected", "complete"}},
        BadInput{"OfTheLastCamera",
                 [](S& s) {
                   s.lines.more_cameras =
                       "  - {name: again, info: camera_info.yaml, depth: [none.png], stamps: [0], "
                       "pose: " +
                       s.lines.pose + "}\n";
                 },
                 {"none.png", "expected"}}),
    name_of_case);

INSTANTIATE_TEST_SUITE_P(
    CameraInfo, BadScene,
    ::testing::Values(
        BadInput{"FocalLengthZero",
                 write("camera_info.yaml", camera_info_text("[0, 0, 31.5, 0, 60, 23.5, 0, 0, 1]")),
                 {"camera_info.yaml:3: camera_matrix.data[0]: 0; expected a number above 0"}},
        BadInput{"OfAnotherSize",
                 [](S& s) {
                   std::string text = camera_info_text();
                   s.write("camera_info.yaml", text.replace(text.find("64"), 2, "640"));
                 },
                 {"depth/000000.png", "64 x 48", "expected 640 x 48"}}),
    name_of_case);

INSTANTIATE_TEST_SUITE_P(
    Joints, BadScene,
    ::testing::Values(BadInput{"CutRow",
                               write("joints.csv", "time,shoulder,elbow\n0,0,0\n1,0,0\n2,0\n"),
                               {"joints.csv:4: 2 fields; expected 3"}},
                      BadInput{"TooFewRows",
                               write("joints.csv", "time,shoulder,elbow\n0,0,0\n1,0,0\n"),
                               {"joints.csv: 2 rows", "the 3 images of camera front", "or stamps"}},
                      BadInput{"OfAnotherTimeThanAllStamps",
                               [](S& s) { s.lines.more_camera = "stamps: [100, 101, 102.5]"; },
                               {"joints.csv", "camera front", "from 100 to 102.5 s",
                                "expected times from 0 to 2 s"}}),
    name_of_case);

INSTANTIATE_TEST_SUITE_P(
    Robot, BadScene,
    ::testing::Values(
        BadInput{"TwoRoots", write("arm.urdf", arm_urdf("<link name=\"alone\"/>")), {"arm.urdf"}},
        BadInput{"MeshMissing",
                 remove_file("parts/lower.stl"),
                 {"arm.urdf", "link \"lower\"", "parts/lower.stl"}},
        BadInput{
            "EnvironmentLinkUnknown",
            set(&SceneLines::robot,
                "{urdf: arm.urdf, package_paths: {arm_parts: parts}, environment_links: [tabel]}"),
            {"arm.urdf", "environment_links", "\"tabel\"", "expected one of", "table"}}),
    name_of_case);

INSTANTIATE_TEST_SUITE_P(
    SceneFile, BadScene,
    ::testing::Values(
        BadInput{"UnknownKey",
                 set(&SceneLines::more, "evalution: {}"),
                 {"scene.yaml:11: evalution: unknown key; expected evaluation (the nearest)"}},
        BadInput{"UnknownParent",
                 set(&SceneLines::pose, "{parent: bsae, xyz: [0, 0, 0], rpy: [0, 0, 0]}"),
                 {"scene.yaml: camera front: parent link \"bsae\"", "expected one of base"}},
        BadInput{"PaddingOfAnUnknownLink",
                 set(&SceneLines::self_filter, "{link_padding_m: {uper: 0.1}}"),
                 {"scene.yaml", "link_padding_m", "\"uper\"", "expected one of", "upper"}}),
    name_of_case);

// Places that cannot be read or written to: refused before any work is done.

TEST(BadPlace, SceneThatIsMissingOrAFolder) {
  const CommandScene scene;
  expect_refused(scene, {"run", "none.yaml"}, {"none.yaml", "No such file", "expected"});
  expect_refused(scene, {"run", "depth"}, {"depth: is a folder; expected a file"});
  expect_refused(scene, {"filter", "none.yaml", "--out", "filtered"}, {"none.yaml", "expected"});
}

TEST(BadPlace, FolderForImagesIsAFile) {
  const CommandScene scene;
  scene.write("taken", "");
  const std::vector<std::string> told = {"taken", "expected a folder"};
  expect_refused(scene, {"filter", "scene.yaml", "--out", "taken"}, told);
  expect_refused(scene, {"filter", "scene.yaml", "--out", "taken/below"}, told);
  expect_refused(scene, {"run", "scene.yaml", "--picture", "taken"}, told);
}

TEST(BadPlace, FolderOfTheLastCameraIsAFile) {
  CommandScene scene;
  scene.lines.more_cameras =
      "  - {name: again, info: camera_info.yaml, depth: [depth/000000.png], stamps: [0], pose: " +
      scene.lines.pose + "}\n";
  fs::create_directories(scene / "f/front");
  scene.write("f/again", "");
  expect_refused(scene, {"filter", "scene.yaml", "--out", "f"}, {"f/again", "expected a folder"});
  expect_refused(scene, {"run", "scene.yaml", "--picture", "f"}, {"f/again", "expected a folder"});
}

TEST(BadPlace, ResultFileCannotBeMade) {
  const CommandScene scene;
  expect_refused(scene, {"run", "scene.yaml", "--picture", "p", "--out", "none/result.txt"},
                 {"none/result.txt", "expected"});
  expect_refused(scene, {"run", "scene.yaml", "--picture", "p", "--out", "depth"},
                 {"depth", "expected"});
}

// `berth evaluate` refuses images that do not fit together.

class BadImages : public ::testing::Test {
 protected:
  BadImages() { EXPECT_EQ(scene.berth({"filter", "scene.yaml", "--out", "f"}).exit_status, 0); }

  void expect_refusal(const std::vector<std::string>& told) const {
    expect_refused(scene,
                   {"evaluate", "--camera", "camera_info.yaml", "--robot-depth",
                    "f/robot_depth_000000.png", "--link-ids", "f/link_ids_000000.png",
                    "--obstacle-depth", "f/obstacle_depth_000000.png", "--out", "result.txt"},
                   told);
  }

  CommandScene scene;
};

TEST_F(BadImages, LinkIdWithoutDepth) {
  Image<LinkId> ids = read_link_ids_png(scene / "f/link_ids_000000.png", scene_camera());
  ASSERT_EQ(ids(3, 2), kNoLink);
  ids(3, 2) = 1;
  write_link_ids_png(scene / "f/link_ids_000000.png", ids);
  expect_refusal(
      {"f/link_ids_000000.png: pixel (3, 2): link ID 1 where f/robot_depth_000000.png has "
       "no depth; expected a depth"});
}

TEST_F(BadImages, LinkIdThatNoLinkHas) {
  Image<LinkId> ids = read_link_ids_png(scene / "f/link_ids_000000.png", scene_camera());
  ids(5, 4) = 65535;
  write_link_ids_png(scene / "f/link_ids_000000.png", ids);
  expect_refusal({"f/link_ids_000000.png: pixel (5, 4): link ID 65535; expected 0 to 65534"});
}

TEST_F(BadImages, EachOfThemMissing) {
  for (const std::string file : {"camera_info.yaml", "f/robot_depth_000000.png",
                                 "f/link_ids_000000.png", "f/obstacle_depth_000000.png"}) {
    fs::rename(scene / file, scene / "aside");
    expect_refusal({file, "No such file", "expected"});
    fs::rename(scene / "aside", scene / file);
  }
}

TEST_F(BadImages, ResultFileCannotBeMade) {
  expect_refused(scene,
                 {"evaluate", "--camera", "camera_info.yaml", "--robot-depth",
                  "f/robot_depth_000000.png", "--link-ids", "f/link_ids_000000.png",
                  "--obstacle-depth", "f/obstacle_depth_000000.png", "--out", "none/result.txt"},
                 {"none/result.txt", "expected"});
}

}  // namespace
}  // namespace berth
