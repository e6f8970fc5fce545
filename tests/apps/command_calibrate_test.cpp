// berth calibrate, as its user sees it.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "berth/files/file_bytes.hpp"
#include "berth/scene/open_scene.hpp"
#include "tests/apps/berth_program.hpp"
#include "tests/support/coarse_arm.hpp"
#include "tests/support/drawn_cell.hpp"

namespace berth {
namespace {

using testing::DrawnCell;
using Json = nlohmann::json;

const std::filesystem::path& kArm =
    testing::coarse_arm_folder(BERTH_SOURCE_DIR "/data/bundled/arm");

DrawnCell small_cell(int poses = 3, const testing::CellLines& lines = {}) {
  return {kArm, {.width_px = 320, .height_px = 240, .poses = poses}, 2, lines};
}

std::vector<std::string> all_names(const std::filesystem::path& folder) {
  std::vector<std::string> names;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder)) {
    names.push_back(entry.path().lexically_relative(folder).string());
  }
  std::sort(names.begin(), names.end());
  return names;
}

/// The one line on standard output.
Json json_of(const Outcome& outcome) {
  EXPECT_EQ(outcome.exit_status, 0) << outcome.err;
  EXPECT_EQ(outcome.err, "");
  EXPECT_EQ(std::count(outcome.out.begin(), outcome.out.end(), '\n'), 1);
  EXPECT_TRUE(outcome.out.ends_with("\n"));
  return Json::parse(outcome.out);
}

/// With one line of message that has these parts, and no new file.
void expect_refused(const DrawnCell& cell, const std::vector<std::string>& arguments,
                    const std::vector<std::string>& told) {
  const std::vector<std::string> before = all_names(cell.folder());
  const Outcome outcome = run_berth(cell.folder(), arguments);
  SCOPED_TRACE(outcome.err);
  EXPECT_EQ(outcome.exit_status, 1);
  EXPECT_EQ(outcome.out, "");
  EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1);
  for (const std::string& part : told) {
    EXPECT_NE(outcome.err.find(part), std::string::npos) << part;
  }
  EXPECT_EQ(all_names(cell.folder()), before);
}

TEST(CalibrateCommand, TheNewSceneOpensAndRunsAndTheOldOneStays) {
  const DrawnCell cell = small_cell();
  const std::string scene_before = read_file_bytes(cell.scene());
  std::filesystem::create_directory(cell / "calibrated");
  const Outcome outcome = run_berth(cell.folder(), {"calibrate", "cell/scene.yaml", "--out",
                                                    "calibrated/new.yaml", "--report", "report"});
  ASSERT_EQ(outcome.exit_status, 0) << outcome.err;
  EXPECT_EQ(outcome.err, "");
  EXPECT_NE(outcome.out.find("camera"), std::string::npos);
  EXPECT_NE(outcome.out.find("tolerance_m"), std::string::npos);

  EXPECT_EQ(read_file_bytes(cell.scene()), scene_before);
  const std::string text = read_file_bytes(cell / "calibrated/new.yaml");
  for (const char* comment : {"# Our cell.", "# above the door", "# as its driver says"}) {
    EXPECT_NE(text.find(comment), std::string::npos) << comment;
  }
  const OpenScene scene = open_scene(cell / "calibrated/new.yaml");
  const SceneCamera& camera = scene.cameras.at(0).source;
  EXPECT_TRUE(camera.settings.watch.is_on());
  EXPECT_LT((camera.X_PC.translation() - cell.drawn.X_PC_true.translation()).norm(), 0.02);
  const Outcome run = run_berth(cell.folder(), {"run", "calibrated/new.yaml", "--format", "json"});
  EXPECT_EQ(run.exit_status, 0) << run.err;
  EXPECT_EQ(std::count(run.out.begin(), run.out.end(), '\n'), 3);

  const std::string page = read_file_bytes(cell / "report/index.html");
  EXPECT_NE(page.find("<html"), std::string::npos);
  EXPECT_NE(page.find("camera"), std::string::npos);
}

TEST(CalibrateCommand, JsonIsOneLineWithTheKeysOfItsFormat) {
  const DrawnCell cell = small_cell();
  const Json json = json_of(
      run_berth(cell.folder(), {"calibrate", "cell/scene.yaml", "--out", "new.yaml", "--format",
                                "json", "--joint-zeros", "--correct-depth", "--threads", "1"}));
  EXPECT_EQ(json.at("schema"), "berth/calibration/1");
  EXPECT_EQ(json.at("frames_used"), 3);
  EXPECT_TRUE(json.at("joint_offsets").is_object());
  ASSERT_EQ(json.at("cameras").size(), 1U);
  const Json& camera = json["cameras"][0];
  EXPECT_EQ(camera.at("camera"), "camera");
  EXPECT_EQ(camera.at("parent"), "table");
  for (const char* key : {"xyz", "sigma_xyz_m", "sigma_rotation_rad"}) {
    ASSERT_EQ(camera.at(key).size(), 3U) << key;
    for (const Json& value : camera[key]) EXPECT_TRUE(value.is_number()) << key;
  }
  EXPECT_EQ(camera.at("quaternion_xyzw").size(), 4U);
  EXPECT_EQ(camera.at("clock_offset_s"), 0.0);
  EXPECT_TRUE(camera.at("depth").at("offset_m").is_number());
  EXPECT_TRUE(camera["depth"].at("scale").is_number());
  for (const char* side : {"before", "after"}) {
    for (const char* share : {"median", "p90", "p99"}) {
      EXPECT_TRUE(camera.at("residual_m").at(side).at(share).is_number()) << side << share;
    }
  }
  EXPECT_EQ(std::count(camera.at("not_determined").begin(), camera["not_determined"].end(),
                       "clock_offset_s"),
            1);
  EXPECT_TRUE(camera.at("self_filter").at("tolerance_m").is_number());
  EXPECT_TRUE(camera["self_filter"].at("padding_m").is_number());
  const SceneFile scene = read_scene(cell / "new.yaml");
  EXPECT_NE(scene.cameras[0].depth_scale_m, 0.001);
  EXPECT_NEAR(scene.cameras[0].depth_scale_m, 0.001 * camera["depth"]["scale"].get<double>(), 1e-8);
  EXPECT_NEAR(scene.cameras[0].depth_offset_m, camera["depth"]["offset_m"].get<double>(), 1e-6);
  EXPECT_EQ(scene.cameras[0].settings.self_filter.tolerance_m,
            camera["self_filter"]["tolerance_m"]);
  for (int i = 0; i < 3; ++i) {
    EXPECT_NEAR(camera["xyz"][i].get<double>(), scene.cameras[0].X_PC.translation()[i], 1e-6);
  }
}

TEST(CalibrateCommand, TheSceneItselfIsRefusedBeforeAnyWork) {
  const DrawnCell cell = small_cell();
  // Were images read, a missing one would be told.
  std::filesystem::remove(cell / "cell/depth/000001.png");
  const std::string before = read_file_bytes(cell.scene());
  std::filesystem::create_symlink(cell.scene(), cell / "link.yaml");
  for (const char* out : {"cell/scene.yaml", "cell/../cell/scene.yaml", "link.yaml"}) {
    expect_refused(cell, {"calibrate", "cell/scene.yaml", "--out", out},
                   {out, "is the scene itself; expected another file for --out"});
  }
  EXPECT_EQ(read_file_bytes(cell.scene()), before);
}

TEST(CalibrateCommand, WhatCannotBeCalibratedIsRefusedAndNothingIsWritten) {
  const DrawnCell cell = small_cell();
  const auto calibrate = [](const std::string& scene) {
    return std::vector<std::string>{"calibrate", scene, "--out", "new.yaml", "--report", "report"};
  };
  expect_refused(cell, calibrate("cell/missing.yaml"), {"missing.yaml"});
  expect_refused(cell, calibrate("cell"), {"cell"});

  const std::string joints = read_file_bytes(cell / "cell/joints.csv");
  std::string still = joints.substr(0, joints.find('\n') + 1);
  const std::string row =
      joints.substr(still.size(), joints.find('\n', still.size()) - still.size());
  const std::string positions = row.substr(row.find(','));
  for (int f = 0; f < 3; ++f) still += fmt::format("{}{}\n", f, positions);
  cell.write("cell/joints.csv", still);
  expect_refused(cell, calibrate("cell/scene.yaml"),
                 {"scene.yaml: camera camera: the arm never moves in its 3 frames"});

  cell.write("cell/joints.csv", joints);
  cell.write("cell/depth/000001.png", "no image");
  expect_refused(cell, calibrate("cell/scene.yaml"), {"000001.png"});
}

TEST(CalibrateCommand, AFolderThatIsNotThereIsTold) {
  const DrawnCell cell = small_cell();
  expect_refused(cell, {"calibrate", "cell/scene.yaml", "--out", "nowhere/new.yaml"},
                 {"nowhere/new.yaml"});
}

TEST(CalibrateCommand, ABackgroundStandsBesideTheNewSceneAndRunsBeginWithIt) {
  const DrawnCell cell = small_cell(3, {.more = "sensor: {background_frames: 1}\n"});
  std::filesystem::create_directory(cell / "calibrated");
  const Outcome outcome = run_berth(cell.folder(), {"calibrate", "cell/scene.yaml", "--out",
                                                    "calibrated/new.yaml", "--background"});
  ASSERT_EQ(outcome.exit_status, 0) << outcome.err;
  EXPECT_EQ(all_names(cell / "calibrated"),
            (std::vector<std::string>{"new.background.camera.png", "new.yaml"}));
  const OpenScene scene = open_scene(cell / "calibrated/new.yaml");
  ASSERT_TRUE(scene.cameras.at(0).background_m.has_value());
  const Outcome run = run_berth(cell.folder(), {"run", "calibrated/new.yaml", "--format", "json"});
  ASSERT_EQ(run.exit_status, 0) << run.err;
  const Json first = Json::parse(run.out.substr(0, run.out.find('\n')));
  EXPECT_GT(first.at("cameras").at(0).at("self_filter").at("background").get<int>(), 100);
}

}  // namespace
}  // namespace berth
