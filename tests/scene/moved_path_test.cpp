// The paths of a scene that was written anew in another folder.
#include "berth/scene/rewrite_scene.hpp"

#include <cmath>

#include "berth/scene/open_scene.hpp"
#include "tests/scene/rewritten_cell.hpp"
#include "tests/support/data_folder.hpp"

namespace berth {
namespace {

namespace fs = std::filesystem;

using MovedPath = RewrittenScene;

TEST_F(MovedPath, LeadsToTheSameFilesFromAnotherFolder) {
  const std::string text =
      "robot: {urdf: ./r.urdf, package_paths: {x: ., y: ../y/, z: /z}, srdf: r.srdf, others: "
      "[{urdf: "
      "s.urdf, package_paths: {x: .}, pose: {parent: p, xyz: [0, 0, 0], rpy: [0, 0, 0]}}]}\n"
      "cameras:\n"
      "  - {name: a, info: 'c d.yaml', depth: ../data/*.png, pose: {parent: p, xyz: [0, 0, 0], "
      "rpy: [0, 0, 0]}}\n"
      "joints: a/../j.csv\n";
  fs::create_directories(folder_ / "cell/calibrated/deep");
  const auto rewritten_for = [&](const std::string& name) {
    return rewritten_scene(write(text), {}, folder_ / name);
  };
  EXPECT_EQ(
      rewritten_for("cell/calibrated/deep/new.yaml"),
      "robot: {urdf: ../../r.urdf, package_paths: {x: ../../, y: ../../../y/, z: /z}, srdf: "
      "../../r.srdf, others: [{urdf: ../../s.urdf, package_paths: {x: ../../}, pose: {parent: "
      "p, xyz: [0, 0, 0], rpy: [0, 0, 0]}}]}\n"
      "cameras:\n"
      "  - {name: a, info: '../../c d.yaml', depth: ../../../data/*.png, pose: {parent: p, "
      "xyz: [0, 0, 0], rpy: [0, 0, 0]}}\n"
      "joints: ../../j.csv\n");
  EXPECT_EQ(
      rewritten_for("new.yaml"),
      "robot: {urdf: cell/r.urdf, package_paths: {x: cell/, y: y/, z: /z}, srdf: cell/r.srdf, "
      "others: [{urdf: cell/s.urdf, package_paths: {x: cell/}, pose: {parent: p, xyz: [0, 0, "
      "0], rpy: [0, 0, 0]}}]}\n"
      "cameras:\n"
      "  - {name: a, info: 'cell/c d.yaml', depth: data/*.png, pose: {parent: p, xyz: [0, 0, "
      "0], rpy: [0, 0, 0]}}\n"
      "joints: cell/j.csv\n");
  EXPECT_EQ(rewritten_for("cell/new.yaml"), text);
}

TEST_F(MovedPath, TakesAFolderWithAPatternsCharacters) {
  folder_.write("odd [1] *, é/depth/0.png", "");
  folder_.write("odd 1 x, é/depth/1.png", "");
  const std::string camera =
      "  - name: a\n"
      "    info: c.yaml\n"
      "    depth: depth/*.png\n"
      "    pose: {parent: p, xyz: [0, 0, 0], rpy: [0, 0, 0]}\n";
  const fs::path file = folder_.write("odd [1] *, é/scene.yaml", scene_of(camera));
  const SceneFile scene = parse_scene(new_file(), rewritten_scene(file, {}, new_file()));
  EXPECT_EQ(scene.cameras[0].depth, (std::vector<fs::path>{folder_ / "odd [1] *, é/depth/0.png"}));
  EXPECT_EQ(scene.cameras[0].info, folder_ / "odd [1] *, é/c.yaml");
}

/// "../" of a linked folder is another one for the reader of scenes than for the file system.
TEST_F(MovedPath, WritesAbsolutePathsWhereALinkLeavesNoOther) {
  fs::create_directories(folder_ / "a/b/real");
  fs::create_directory_symlink(folder_ / "a/b/real", folder_ / "link");
  const std::string text = scene_of(kBlockCamera);
  const std::string new_text = rewritten_scene(write(text), {}, folder_ / "link/new.yaml");
  for (const char* name : {"link/new.yaml", "a/b/real/new.yaml"}) {
    const SceneFile scene = parse_scene(folder_ / name, new_text);
    EXPECT_EQ(scene.robot.urdf, folder_ / "cell/r.urdf") << name;
    EXPECT_EQ(scene.cameras[0].depth[0], folder_ / "cell/depth/0.png") << name;
  }
  // A link that no path goes through by ".." changes nothing.
  fs::create_directory_symlink(folder_ / "cell", folder_ / "cell link");
  EXPECT_EQ(rewritten_scene(folder_ / "cell link/scene.yaml", {}, folder_ / "cell/new.yaml"), text);
}

TEST_F(MovedPath, TakesPathsThatBeginInTheWorkingFolder) {
  struct WorkingFolder {
    explicit WorkingFolder(const fs::path& folder) { fs::current_path(folder); }
    ~WorkingFolder() { fs::current_path(before); }
    fs::path before = fs::current_path();
  };
  const std::string text = scene_of(kBlockCamera);
  const fs::path file = write(text);
  const std::string expected = rewritten_scene(file, {}, new_file());
  const WorkingFolder in_cell(folder_ / "cell");
  EXPECT_EQ(rewritten_scene("scene.yaml", {}, "new.yaml"), text);
  EXPECT_EQ(rewritten_scene("scene.yaml", {}, "../calibrated/new.yaml"), expected);
  EXPECT_EQ(rewritten_scene("./scene.yaml", {}, new_file()), expected);
}

TEST_F(MovedPath, ABundledSceneOpensFromItsNewPlace) {
  const fs::path file = BERTH_SOURCE_DIR "/data/bundled/scene.yaml";
  const OpenScene scene = open_scene(file);
  SceneChange change;
  for (const OpenCamera& camera : scene.cameras) {
    change.cameras.push_back({camera.source.name, some_pose(), {}, {}, -0.25, {}});
  }
  write_rewritten_scene(file, change, new_file());
  const OpenScene rewritten_one = open_scene(new_file());
  ASSERT_EQ(rewritten_one.cameras.size(), scene.cameras.size());
  EXPECT_EQ(rewritten_one.frame_count, scene.frame_count);
  for (std::size_t i = 0; i < scene.cameras.size(); ++i) {
    const DepthImage depth_m = scene.cameras[i].read_depth(0);
    const DepthImage nearer_m = rewritten_one.cameras[i].read_depth(0);
    ASSERT_EQ(nearer_m.pixels().size(), depth_m.pixels().size());
    int readings = 0;
    for (std::size_t k = 0; k < depth_m.pixels().size(); ++k) {
      if (std::isnan(depth_m.pixels()[k])) {
        EXPECT_TRUE(std::isnan(nearer_m.pixels()[k]));
      } else {
        EXPECT_NEAR(nearer_m.pixels()[k], depth_m.pixels()[k] - 0.25, 1e-6);
        ++readings;
      }
    }
    EXPECT_GT(readings, 1000);
  }
}

/// Somebody's real recordings, where they are.
TEST_F(MovedPath, TheRealRecordingsLeadToTheSameFilesFromElsewhere) {
  const fs::path recordings = data_folder() / "recordings";
  if (!fs::exists(recordings)) GTEST_SKIP() << recordings << " is missing; set BERTH_DATA";
  for (const char* name : {"xarm7_realsense", "lbr_med7_zed2i"}) {
    const fs::path file = recordings / name / "scene.yaml";
    const SceneFile scene =
        parse_scene(new_file(), rewritten_scene(file, full_change("camera"), new_file()));
    EXPECT_TRUE(fs::exists(scene.robot.urdf));
    EXPECT_TRUE(fs::equivalent(scene.joints, recordings / name / "joints.csv"));
    EXPECT_TRUE(fs::equivalent(scene.cameras[0].depth[1], recordings / name / "depth/000001.png"));
    EXPECT_EQ(scene.cameras[0].depth_offset_m, 0.004);
  }
}

}  // namespace
}  // namespace berth
