#include "berth/scene/rewrite_scene.hpp"

#include <limits>
#include <numbers>

#include "berth/files/file_bytes.hpp"
#include "sim/random.hpp"
#include "tests/scene/rewritten_cell.hpp"

namespace berth {
namespace {

namespace fs = std::filesystem;

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

TEST_F(RewrittenScene, KeepsTheTextOfALongScene) {
  const std::string text = R"(# The cell at the window, ü.
robot: {urdf: ../robots/arm.urdf, package_paths: {arm: '../robots/arm', far: /opt/far}}   # paths
cameras:
  # Left of the door.
  - name: left
    info: left.yaml	# from the driver
    pose:                                  # by a tape measure
      parent: base
      xyz:
        - 1.5                              # forward
        - 0
        - .8                               # up
      rpy: [-1.8, 0, 1.57]                 # down a little
    depth: depth/*.png
    depth_scale: 0.001                     # of the driver
                                           # (as it says)

    # Its own settings.
    self_filter:
      tolerance_m: 0.05                    # guessed
      link_padding_m: {hand: 0.01}
  - {name: right, info: right.yaml, pose: {parent: base, xyz: [0, 0, 1], quaternion_xyzw: [0, 0, 0, 1]}, depth: [depth/0.png, "../data/1.png", /data/2.png], sensor: {}}
joints: joints.csv
attached: [{link: hand, mesh: tool.stl}, {link: hand, sphere: 0.1}]
evaluation: {range_m: 0.8} # the end
)";
  const std::string expected = R"(# The cell at the window, ü.
robot: {urdf: ../robots/arm.urdf, package_paths: {arm: '../robots/arm', far: /opt/far}}   # paths
cameras:
  # Left of the door.
  - name: left
    info: ../cell/left.yaml	# from the driver
    pose:                                  # by a tape measure
      parent: base
      xyz:
        - 0.25                              # forward
        - -1.5
        - 0.123456789                               # up
      rpy: [-1.5707963268, 0, -1.5707963268]                 # down a little
    depth: ../cell/depth/*.png
    depth_scale: 0.001013                     # of the driver
                                           # (as it says)
    clock_offset_s: -0.0125
    depth_offset_m: 0.004
    sensor: {speckle_px: 20}

    # Its own settings.
    self_filter:
      tolerance_m: 0.03                    # guessed
      tolerance_per_m2: 2
      link_padding_m: {hand: 0.01}
  - {name: right, info: ../cell/right.yaml, clock_offset_s: -0.0125, pose: {parent: base, xyz: [0.25, -1.5, 0.123456789], quaternion_xyzw: [-0.5, 0.5, -0.5, 0.5]}, depth: [../cell/depth/0.png, "../data/1.png", /data/2.png], sensor: {}}
joints: ../cell/joints.csv
joint_offsets: {joint_2: 0.004}
attached: [{link: hand, mesh: ../cell/tool.stl}, {link: hand, sphere: 0.1}]
evaluation: {range_m: 0.8} # the end
)";
  SceneChange change = full_change("left");
  SceneCameraChange right{"right", some_pose(), -0.0125, {}, {}, {}};
  change.cameras.push_back(right);
  EXPECT_EQ(rewritten_scene(write(text), change, new_file()), expected);
}

TEST_F(RewrittenScene, LeavesATextWithoutChangesAsItIs) {
  const std::string on_one_line =
      "{robot: {urdf: r}, joints: j, cameras: [{name: a, info: &i i, depth: depth/*.png, pose: "
      "{parent: *i, xyz: [+1, 1e0, .5], rpy: [0, 0, 0]}}]}";
  for (const std::string& text :
       {scene_of(kBlockCamera + kFlowCamera), with_windows_lines(scene_of(kFlowCamera)),
        on_one_line, scene_of(kBlockCamera, "joints:   './/j.csv'  # \t odd\n\n\n# the end")}) {
    EXPECT_EQ(rewritten(text, {}), text);
  }
}

TEST_F(RewrittenScene, TakesAllKindsOfLinesAndEnds) {
  const std::string pose = "{parent: p, xyz: [0.25, -1.5, 0.123456789], ";
  const std::string block =
      "  - name: a\n"
      "    info: c.yaml\n"
      "    clock_offset_s: -0.0125\n"
      "    depth_offset_m: 0.004\n"
      "    depth_scale: 0.001013\n"
      "    sensor: {speckle_px: 20}\n"
      "    self_filter: {tolerance_m: 0.03, tolerance_per_m2: 2}\n"
      "    pose: " +
      pose +
      "rpy: [-1.5707963268, 0, -1.5707963268]}\n"
      "    depth: [depth/0.png]\n";
  const std::string flow =
      "  - {name: b, info: c.yaml, clock_offset_s: -0.0125, depth_offset_m: 0.004, depth_scale: "
      "0.001013, sensor: {speckle_px: 20}, self_filter: {tolerance_m: 0.03, tolerance_per_m2: 2}, "
      "pose: " +
      pose + "quaternion_xyzw: [-0.5, 0.5, -0.5, 0.5]}, depth: [depth/0.png]}\n";
  SceneChange change = full_change("a");
  change.cameras.push_back(full_change("b").cameras[0]);
  const std::string text = scene_of(kBlockCamera + kFlowCamera);
  const std::string expected =
      scene_of(block + flow, "joints: j.csv\njoint_offsets: {joint_2: 0.004}\n");
  EXPECT_EQ(rewritten(text, change), expected);
  EXPECT_EQ(rewritten(with_windows_lines(text), change), with_windows_lines(expected));
  EXPECT_EQ(rewritten("\xEF\xBB\xBF" + text, change), "\xEF\xBB\xBF" + expected);
  const auto without_end = [](std::string line) {
    line.pop_back();
    return line;
  };
  EXPECT_EQ(rewritten(without_end(text), change), without_end(expected));
}

TEST_F(RewrittenScene, ReadsBackWhatWasChangedAndAllElse) {
  const std::string text =
      scene_of(kBlockCamera + "    self_filter: {padding_m: 0.07}\n    near_m: 0.3\n" + kFlowCamera,
               "joints: j.csv\nself_filter: {tolerance_m: 0.06}\njoint_offsets: {j1: 1, j2: 2}\n");
  SceneChange change = full_change("a");
  change.joint_offsets = {{"j2", 1.0 / 3}, {"j.3 x", -1e-5}};
  const SceneFile scene = reread(text, change);
  const SceneCamera& a = scene.cameras[0];
  EXPECT_EQ(a.clock_offset_s, -0.0125);
  EXPECT_EQ(a.depth_scale_m, 0.001013);
  EXPECT_EQ(a.depth_offset_m, 0.004);
  EXPECT_EQ(a.near_m, 0.3);
  EXPECT_EQ(a.settings.self_filter.tolerance_m, 0.03);
  EXPECT_EQ(a.settings.self_filter.padding_m, 0.07);
  EXPECT_EQ(a.settings.self_filter.tolerance_per_m2, 2);
  EXPECT_EQ(a.settings.sensor.speckle_px, 20);
  EXPECT_EQ(scene.cameras[1].settings.self_filter.tolerance_m, 0.06);
  EXPECT_EQ(scene.cameras[1].depth_offset_m, 0);
  EXPECT_EQ(scene.joint_offsets,
            (std::map<std::string, double>{{"j1", 1}, {"j2", 1.0 / 3}, {"j.3 x", -1e-5}}));
}

TEST_F(RewrittenScene, LeadsEditorsToTheSchemaFromItsNewPlace) {
  const std::string line = "# yaml-language-server: $schema=";
  for (const auto& [before, after] : {std::pair("schema.json", "../cell/schema.json"),
                                      std::pair("/usr/share/s.json", "/usr/share/s.json"),
                                      std::pair("https://a.org/s.json", "https://a.org/s.json")}) {
    const fs::path scene = write(line + before + "\n" + scene_of(kBlockCamera));
    const std::string text = rewritten_scene(scene, {}, new_file());
    EXPECT_EQ(text.substr(0, text.find('\n')), line + after);
  }
}

TEST_F(RewrittenScene, WritesOtherValuesAtTheirPlaces) {
  const std::string text = scene_of(kBlockCamera + kFlowCamera);
  SceneChange change;
  change.values = {{{"evaluation", "range_m"}, "0.7"},
                   {{"self_filter", "padding_m"}, "0.03"},
                   {{"cameras", "1", "space", "no_reading"}, "hides"}};
  const SceneFile scene = reread(text, change);
  EXPECT_EQ(scene.evaluation.distance.range_m, 0.7);
  EXPECT_EQ(scene.cameras[0].settings.self_filter.padding_m, 0.03);
  EXPECT_EQ(scene.cameras[0].settings.space.no_reading, NoReading::unknown);
  EXPECT_EQ(scene.cameras[1].settings.space.no_reading, NoReading::hides);
}

TEST_F(RewrittenScene, WritesWhatIsCarriedInFrontOfTheRest) {
  SceneChange change;
  change.attached = {{"hand", folder_ / "cell/new.attached.a.stl", "a"},
                     {"arm", folder_ / "cell/new.attached.b.stl", "b"}};
  const std::string text = scene_of(kBlockCamera);
  for (const std::string& old : {std::string(), std::string("attached:\n  # held\n  - link: p\n"
                                                            "    box: [1, 1, 1]\n")}) {
    const SceneFile scene = reread(text + old, change);
    ASSERT_EQ(scene.attached.size(), old.empty() ? 2U : 3U);
    EXPECT_EQ(scene.attached[0].link, "arm");
    EXPECT_EQ(scene.attached[0].name, "b");
    EXPECT_EQ(scene.attached[1].mesh, folder_ / "cell/new.attached.a.stl");
    if (!old.empty()) {
      EXPECT_EQ(scene.attached[2].link, "p");
    }
  }
}

/// Also where the angles about x and z are not told apart.
TEST_F(RewrittenScene, WritesPosesInTheUsersKindOfRotation) {
  sim::Random random(1);
  const std::string text = scene_of(kBlockCamera + kFlowCamera);
  const double right_angle = std::numbers::pi / 2;
  for (int i = 0; i < 60; ++i) {
    const double near_right_angle = right_angle + (i % 4 == 0 ? 0 : random(-1e-7, 1e-7));
    const Eigen::Vector3d rpy =
        i % 3 == 0 ? Eigen::Vector3d(random(-3, 3),
                                     random.chance(0.5) ? near_right_angle : -near_right_angle,
                                     i % 2 == 0 ? 0 : random(-3, 3))
                   : sim::draw_point(random, 4);
    const Pose X_PC = Eigen::Translation3d(sim::draw_point(random, 3)) *
                      Eigen::AngleAxisd(rpy[2], Eigen::Vector3d::UnitZ()) *
                      Eigen::AngleAxisd(rpy[1], Eigen::Vector3d::UnitY()) *
                      Eigen::AngleAxisd(rpy[0], Eigen::Vector3d::UnitX());
    for (const std::size_t camera : {0, 1}) {
      const SceneFile scene = reread(text, pose_change(camera == 0 ? "a" : "b", X_PC));
      EXPECT_LE((scene.cameras[camera].X_PC.matrix() - X_PC.matrix()).cwiseAbs().maxCoeff(), 1e-9);
      EXPECT_TRUE(scene.cameras[1 - camera].X_PC.matrix().isIdentity(0));
    }
  }
}

TEST_F(RewrittenScene, WritesShortNumbersAndTheUsersSign) {
  const std::string text = scene_of(
      "  - {name: a, info: c, depth: [0.png], pose: {parent: p, xyz: [-0, 1.5, 2], "
      "quaternion_xyzw: "
      "[-0.6, 0, 0, -0.8]}}\n");
  const Pose X_PC = Eigen::Translation3d(-1e-13, 1.5, 100) * Eigen::Quaterniond(0.6, 0.8, 0, 0);
  EXPECT_NE(rewritten(text, pose_change("a", X_PC))
                .find("xyz: [0, 1.5, 100], quaternion_xyzw: [-0.8, 0, 0, -0.6]"),
            std::string::npos);
}

TEST_F(RewrittenScene, RefusesWhatTwoCamerasShare) {
  const std::string pose = "parent: p, xyz: [0, 0, 0], rpy: [0, 0, 0]}";
  const std::string shared_pose =
      scene_of("  - {name: a, info: c, depth: [0.png], pose: &x {" + pose +
               "}\n  - {name: b, info: c, depth: [0.png], pose: *x}\n");
  expect_refused(
      shared_pose, pose_change("a", some_pose()),
      {"scene.yaml:3: cameras[1].pose.rpy[0]: would become -1.57", "; expected 0; an alias"});
  const std::string shared_filter = scene_of(
      "  - {name: a, info: c, depth: [0.png], self_filter: &x {padding_m: 0.01}, pose: {" + pose +
      "}\n  - {name: b, info: c, depth: [0.png], self_filter: *x, pose: {" + pose + "}\n");
  expect_refused(
      shared_filter, maps_change("b", "self_filter", "tolerance_m", 0.1),
      {"scene.yaml:3: cameras[0].self_filter.tolerance_m: would become 0.1; expected no such key"});
  expect_refused(shared_filter, maps_change("a", "self_filter", "padding_m", 0.1),
                 {"cameras[1].self_filter.padding_m: would become 0.1; expected 0.01"});
  // What moves to the same place for both is no harm.
  EXPECT_NE(rewritten_scene(write("robot: {urdf: &f f}\njoints: *f\ncameras:\n" + kBlockCamera), {},
                            new_file())
                .find("{urdf: &f ../cell/f}\njoints: *f\n"),
            std::string::npos);
}

TEST_F(RewrittenScene, RefusesValuesThatNoSceneHas) {
  const std::string text = scene_of(kBlockCamera);
  const auto refuse = [&](const SceneChange& change, const std::vector<std::string>& parts) {
    expect_refused(text, change, parts);
  };
  refuse(maps_change("a", "self_filter", "tolerance_m", -1),
         {"new.yaml:5: cameras[0].self_filter.tolerance_m: -1; expected a number, 0 or more"});
  refuse(maps_change("a", "self_filter", "toleranc_m", 1), {"self_filter.toleranc_m: unknown key"});
  refuse(maps_change("a", "self_filters", "tolerance_m", 1),
         {"cameras[0].self_filters: unknown key"});
  refuse(maps_change("a", "name", "tolerance_m", 1),
         {"scene.yaml:3: cameras[0].name.tolerance_m: cannot be added here"});
  refuse({{{"a", {}, kNan, {}, {}, {}}}, {}}, {"clock_offset_s: nan; expected a finite number"});
  refuse({{{"a", {}, {}, 1.0, {}, {}}}, {}}, {"depth_scale: 1; expected metres per unit"});
  refuse({{{"a", {}, {}, {}, 1.5, {}}}, {}}, {"depth_offset_m: 1.5; expected metres, -1 to 1"});
  refuse({{}, {{"j", kNan}}}, {"joint_offsets.j: nan; expected a finite number"});
  Pose stretched = some_pose();
  stretched.linear() *= 1.001;
  refuse(pose_change("a", stretched), {"scene.yaml: cameras[0].pose: would be off by 0.001"});
  refuse(pose_change("a", unset_pose()), {"cameras[0].pose.", "nan; expected a finite number"});
  expect_refused(scene_of(""), {}, {"scene.yaml:2: cameras: nothing; expected a list"});
  expect_parts(error_message<std::invalid_argument>(
                   [&] { rewritten(text, maps_change("c", "sensor", "speckle_px", 1)); }),
               {"scene.yaml: no camera is named c"});
}

TEST_F(RewrittenScene, NeverOverwritesItsScene) {
  const std::string text = scene_of(kBlockCamera);
  const fs::path file = write(text);
  const SceneChange change = full_change("a");
  fs::create_symlink(file, folder_ / "cell/symbolic.yaml");
  fs::create_hard_link(file, folder_ / "cell/hard.yaml");
  for (const char* same : {"cell/scene.yaml", "calibrated/../cell/scene.yaml", "cell/symbolic.yaml",
                           "cell/hard.yaml"}) {
    expect_parts(
        error_message([&] { write_rewritten_scene(file, change, folder_ / same); }),
        {(folder_ / same).string() + ": is the same file as " + file.string() + "; expected"});
  }
  EXPECT_EQ(read_file_bytes(file), text);
}

TEST_F(RewrittenScene, WritesAWholeFileOrNone) {
  const fs::path file = write(scene_of(kBlockCamera));
  const SceneChange change = full_change("a");
  expect_parts(
      error_message([&] { write_rewritten_scene(file, change, folder_ / "none/new.yaml"); }),
      {"none/new.yaml: its folder is missing; expected"});
  SceneChange wrong = change;
  wrong.cameras[0].depth_offset_m = kNan;
  EXPECT_THROW(write_rewritten_scene(file, wrong, new_file()), std::runtime_error);
  EXPECT_TRUE(fs::is_empty(folder_ / "calibrated"));
  for (int i = 0; i < 2; ++i) {
    write_rewritten_scene(file, change, new_file());
    EXPECT_EQ(read_file_bytes(new_file()), rewritten_scene(file, change, new_file()));
    EXPECT_EQ(std::distance(fs::directory_iterator(folder_ / "calibrated"), {}), 1);
  }
  EXPECT_EQ(read_scene(new_file()).cameras[0].depth_offset_m, 0.004);
}

}  // namespace
}  // namespace berth
