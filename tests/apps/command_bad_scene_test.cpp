// A bad input gives exit status 1, a message with file, place, value and what was expected, and
// neither output nor files.
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

std::function<void(S&)> link_to(const std::string& name, const std::string& target) {
  return [=](S& s) {
    fs::remove(s / name);
    fs::create_symlink(target, s / name);
  };
}

std::vector<BadInput> no_files() {
  std::vector<BadInput> inputs;
  for (const auto& [label, name] :
       {std::pair("DepthImage", "depth/000000.png"), std::pair("CameraInfo", "camera_info.yaml"),
        std::pair("Joints", "joints.csv"), std::pair("Robot", "arm.urdf"),
        std::pair("Mesh", "parts/lower.stl")}) {
    const std::string file = name;
    const std::string own_name = fs::path(file).filename();
    inputs.push_back({std::string(label) + "IsAPipe",
                      pipe(file),
                      {file + ": is a pipe or device; expected a regular file"}});
    inputs.push_back({std::string(label) + "HasNoEnd",
                      link_to(file, "/dev/zero"),
                      {file + ": is a pipe or device; expected a regular file"}});
    inputs.push_back({std::string(label) + "IsALinkToItself",
                      link_to(file, own_name),
                      {file + ": Too many levels of symbolic links; expected a readable file"}});
    inputs.push_back({std::string(label) + "IsAFolder",
                      [=](S& s) {
                        fs::remove(s / file);
                        fs::create_directory(s / file);
                      },
                      {file + ": is a folder; expected a file"}});
  }
  return inputs;
}

INSTANTIATE_TEST_SUITE_P(NoFile, BadScene, ::testing::ValuesIn(no_files()), name_of_case);

INSTANTIATE_TEST_SUITE_P(
    DepthImage, BadScene,
    ::testing::Values(
        BadInput{"Missing", remove_file("depth/000000.png"), {"depth/000000.png", "expected"}},
        BadInput{"Empty", write("depth/000000.png", ""), {"depth/000000.png", "expected"}},
        BadInput{
            "Cut", cut_image("depth/000000.png"), {"depth/000000.png", "expected", "complete"}},
        BadInput{
            "OfAnotherSize",
            [](S& s) { write_depth_png(s / "depth/000000.png", DepthImage(32, 48, 2), 0.001); },
            {"depth/000000.png", "32 x 48", "expected", "64 x 48"}},
        BadInput{"Of8Bits",
                 [](S& s) {
                   write_link_ids_png(s / "depth/000000.png", Image<LinkId>(64, 48, LinkId{7}));
                 },
                 {"depth/000000.png", "8-bit", "expected 16-bit grayscale"}},
        BadInput{"LastOfSeveral", cut_image("depth/000002.png"), {"depth/000002.png", "expected"}},
        BadInput{"OfTheLastCamera",
                 [](S& s) {
                   s.lines.more_cameras =
                       "  - {name: again, info: camera_info.yaml, depth: [none.png], pose: " +
                       s.lines.pose + "}\n";
                 },
                 {"none.png", "expected"}},
        BadInput{
            "NoPngAtAll", write("depth/000001.png", "depth"), {"depth/000001.png", "expected"}},
        BadInput{"PatternWithoutMatch",
                 set(&SceneLines::depth, "depth/*.tiff"),
                 {"scene.yaml:6: cameras[0].depth: depth/*.tiff; expected"}}),
    name_of_case);

INSTANTIATE_TEST_SUITE_P(
    CameraInfo, BadScene,
    ::testing::Values(
        BadInput{"Missing", remove_file("camera_info.yaml"), {"camera_info.yaml", "expected"}},
        BadInput{"FocalLengthZero",
                 write("camera_info.yaml", camera_info_text("[0, 0, 31.5, 0, 60, 23.5, 0, 0, 1]")),
                 {"camera_info.yaml:3: camera_matrix.data[0]: 0; expected a number above 0"}},
        BadInput{
            "FocalLengthNaN",
            write("camera_info.yaml", camera_info_text("[.nan, 0, 31.5, 0, 60, 23.5, 0, 0, 1]")),
            {"camera_info.yaml:3: camera_matrix.data[0]: .nan; expected a finite number"}},
        BadInput{
            "FocalLengthAsAPartOfTheWidth",
            write("camera_info.yaml", camera_info_text("[0.5, 0, 31.5, 0, 60, 23.5, 0, 0, 1]")),
            {"camera_info.yaml:3: camera_matrix.data[0]: 0.5; expected pixels, from 0.64 to"}},
        BadInput{"CenterFarAway",
                 write("camera_info.yaml", camera_info_text("[60, 0, 1e30, 0, 60, 23.5, 0, 0, 1]")),
                 {"camera_info.yaml:3: camera_matrix.data[2]: 1e30; expected pixels, from -6400"}},
        BadInput{"OfAnotherSize",
                 [](S& s) {
                   std::string text = camera_info_text();
                   s.write("camera_info.yaml", text.replace(text.find("64"), 2, "640"));
                 },
                 {"depth/000000.png", "64 x 48", "expected the camera's 640 x 48"}}),
    name_of_case);

INSTANTIATE_TEST_SUITE_P(
    Joints, BadScene,
    ::testing::Values(BadInput{"Missing", remove_file("joints.csv"), {"joints.csv", "expected"}},
                      BadInput{"UnknownColumn",
                               write("joints.csv",
                                     "time,shoulder,elbow,wrist\n0,0,0,0\n1,0,0,0\n2,0,0,0\n"),
                               {"joints.csv", "\"wrist\"", "expected shoulder, elbow"}},
                      BadInput{"MissingColumn",
                               write("joints.csv", "time,shoulder\n0,0\n1,0\n2,0\n"),
                               {"joints.csv", "\"elbow\"", "missing", "expected"}},
                      BadInput{"NaN",
                               write("joints.csv", "time,shoulder,elbow\n0,0,0\n1,nan,0\n2,0,0\n"),
                               {"joints.csv:3: shoulder: 'nan'; expected a finite number"}},
                      BadInput{"Utf16",
                               write("joints.csv", std::string("t\0i\0m\0e\0", 8)),
                               {"joints.csv: holds a zero byte; expected UTF-8 text"}},
                      BadInput{"CutRow",
                               write("joints.csv", "time,shoulder,elbow\n0,0,0\n1,0,0\n2,0\n"),
                               {"joints.csv:4: 2 fields; expected 3"}},
                      BadInput{"TooFewRows",
                               write("joints.csv", "time,shoulder,elbow\n0,0,0\n1,0,0\n"),
                               {"joints.csv", "2 rows", "frame 2"}},
                      BadInput{"OfAnotherTimeThanAllStamps",
                               [](S& s) { s.lines.more_camera = "stamps: [100, 101, 102.5]"; },
                               {"joints.csv", "camera front", "from 100 to 102.5 s",
                                "expected times from 0 to 2 s"}}),
    name_of_case);

INSTANTIATE_TEST_SUITE_P(
    Robot, BadScene,
    ::testing::Values(
        BadInput{"Missing", remove_file("arm.urdf"), {"arm.urdf"}},
        BadInput{"Empty", write("arm.urdf", ""), {"arm.urdf", "expected <robot>"}},
        BadInput{"Loop",
                 write("arm.urdf", arm_urdf("<joint name=\"back\" type=\"fixed\"><parent "
                                            "link=\"finger\"/><child link=\"upper\"/></joint>")),
                 {"arm.urdf", "upper"}},
        BadInput{"TwoRoots", write("arm.urdf", arm_urdf("<link name=\"alone\"/>")), {"arm.urdf"}},
        BadInput{"NoRoot",
                 write("arm.urdf", arm_urdf("<joint name=\"back\" type=\"fixed\"><parent "
                                            "link=\"finger\"/><child link=\"base\"/></joint>")),
                 {"arm.urdf"}},
        BadInput{"MeshMissing",
                 remove_file("parts/lower.stl"),
                 {"arm.urdf", "link \"lower\"", "parts/lower.stl"}},
        BadInput{"MeshCut",
                 write("parts/lower.stl", "solid box\nfacet normal 0 0 0\n"),
                 {"arm.urdf", "parts/lower.stl", "expected"}},
        BadInput{"PackageUnknown",
                 set(&SceneLines::robot, "{urdf: arm.urdf}"),
                 {"arm.urdf", "arm_parts", "expected one of package_paths"}},
        BadInput{
            "EnvironmentLinkUnknown",
            set(&SceneLines::robot,
                "{urdf: arm.urdf, package_paths: {arm_parts: parts}, environment_links: [tabel]}"),
            {"arm.urdf", "environment_links", "\"tabel\"", "expected one of", "table"}},
        BadInput{"IgnoredLinkUnknown",
                 set(&SceneLines::robot,
                     "{urdf: arm.urdf, package_paths: {arm_parts: parts}, ignore_links: [tool]}"),
                 {"arm.urdf", "ignore_links", "\"tool\"", "expected one of"}}),
    name_of_case);

INSTANTIATE_TEST_SUITE_P(
    SceneFile, BadScene,
    ::testing::Values(
        BadInput{"UnknownKey",
                 set(&SceneLines::more, "evalution: {}"),
                 {"scene.yaml:11: evalution: unknown key; expected evaluation (the nearest)"}},
        BadInput{"UnknownCameraKey",
                 set(&SceneLines::more_camera, "depthscale: 1"),
                 {"scene.yaml:7: cameras[0].depthscale: unknown key; expected depth_scale"}},
        BadInput{"UnknownFilterKey",
                 set(&SceneLines::self_filter, "{padding: 1}"),
                 {"scene.yaml:9: self_filter.padding: unknown key; expected padding_m"}},
        BadInput{"RegionSmallerThanTheRobot",
                 set(&SceneLines::self_filter, "{robot_region_scale: 0.5}"),
                 {"scene.yaml", "self_filter.robot_region_scale: 0.5; expected", "at least 1"}},
        BadInput{"UnknownParent",
                 set(&SceneLines::pose, "{parent: bsae, xyz: [0, 0, 0], rpy: [0, 0, 0]}"),
                 {"scene.yaml", "parent link \"bsae\"", "expected one of base"}},
        BadInput{"PoseIsNaN",
                 set(&SceneLines::pose, "{parent: base, xyz: [0, .nan, 0], rpy: [0, 0, 0]}"),
                 {"scene.yaml:5: cameras[0].pose.xyz[1]: .nan; expected a finite number"}},
        BadInput{"RangeZero",
                 set(&SceneLines::evaluation, "{range_m: 0}"),
                 {"scene.yaml:10: evaluation.range_m: 0; expected a number above 0"}},
        BadInput{"RangeNegative",
                 set(&SceneLines::evaluation, "{range_m: -1}"),
                 {"scene.yaml:10: evaluation.range_m: -1; expected a number above 0"}},
        BadInput{"ToleranceNegative",
                 set(&SceneLines::self_filter, "{tolerance_m: -0.01}"),
                 {"scene.yaml:9: self_filter.tolerance_m: -0.01; expected a number, 0 or more"}},
        BadInput{"PaddingOfAnUnknownLink",
                 set(&SceneLines::self_filter, "{link_padding_m: {uper: 0.1}}"),
                 {"scene.yaml", "link_padding_m", "\"uper\"", "expected one of", "upper"}},
        BadInput{"MethodUnknown",
                 set(&SceneLines::evaluation, "{method: guess}"),
                 {"scene.yaml:10: evaluation.method: guess; expected one of mesh, exact, brute_force"}},
        BadInput{"TimeLimitNegative",
                 set(&SceneLines::more, "time: {max_skew_s: -1}"),
                 {"scene.yaml:11: time.max_skew_s: -1; expected a number, 0 or more"}},
        BadInput{"TimeLimitUnknown",
                 set(&SceneLines::more, "time: {max_skew: 1}"),
                 {"scene.yaml:11: time.max_skew: unknown key; expected max_skew_s"}},
        BadInput{"StampsTooFew",
                 set(&SceneLines::more_camera, "stamps: [0, 1]"),
                 {"scene.yaml:7: cameras[0].stamps: 2 stamps; expected one for each of the 3"}},
        BadInput{
            "DepthScaleTurnedUpsideDown",
            set(&SceneLines::more_camera, "depth_scale: 1000"),
            {"scene.yaml:7: cameras[0].depth_scale: 1000; expected metres per unit from 1e-6"}},
        BadInput{"PoseOutOfThisWorld",
                 set(&SceneLines::pose, "{parent: base, xyz: [0, 1e300, 0], rpy: [0, 0, 0]}"),
                 {"scene.yaml:5: cameras[0].pose.xyz[1]: 1e300; expected metres, 100 km at"}},
        BadInput{"DepthScaleZero",
                 set(&SceneLines::more_camera, "depth_scale: 0"),
                 {"scene.yaml:7: cameras[0].depth_scale: 0; expected a number above 0"}}),
    name_of_case);

}  // namespace
}  // namespace berth
