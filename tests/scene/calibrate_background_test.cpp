// The background that calibration's images give, and what a scene makes of its PNG.
#include "berth/scene/calibrate_background.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "berth/files/file_bytes.hpp"
#include "berth/scene/scene_run.hpp"
#include "tests/support/coarse_arm.hpp"
#include "tests/support/drawn_cell.hpp"
#include "tests/support/error_message.hpp"

namespace berth {
namespace {

using sim::DrawnMount;
using testing::CellLines;
using testing::DrawnCell;

const std::filesystem::path& kArmFolder =
    testing::coarse_arm_folder(BERTH_SOURCE_DIR "/data/bundled/arm");

DrawnCell right_cell(CellLines lines = {}, DrawnMount mount = DrawnMount::root) {
  lines.offset_m = lines.angle_rad = 0;
  return {kArmFolder, {.width_px = 160, .height_px = 120, .poses = 4, .mount = mount}, 2, lines};
}

/// Of the scene as it is: nothing is fitted. new.yaml and its background are there afterwards.
std::vector<CalibratedBackground> calibrate_cell(const DrawnCell& cell) {
  SceneChange change;
  const auto calibrated = calibrate_backgrounds(
      open_scene(cell.scene()), cell / "new.yaml", [] {}, change);
  write_backgrounds(calibrated.learned);
  write_rewritten_scene(cell.scene(), change, cell / "new.yaml");
  return calibrated.learned;
}

/// The one sentence, and nothing changes.
std::string why_none(const std::filesystem::path& scene, const std::filesystem::path& new_file) {
  SceneChange change;
  const auto calibrated = calibrate_backgrounds(
      open_scene(scene), new_file, [] {}, change);
  EXPECT_TRUE(calibrated.learned.empty());
  EXPECT_TRUE(change.cameras.empty());
  return calibrated.without.size() == 1 ? calibrated.without[0] : "";
}

/// Obstacles of all images: with the background that the file names, and with the one that the run
/// learns by itself.
struct TwoRuns {
  std::vector<ObstacleImage> named;
  std::vector<ObstacleImage> learned;

  explicit TwoRuns(SceneFile scene) {
    named = run(scene);
    scene.cameras[0].background.reset();
    learned = run(scene);
  }

  static std::vector<ObstacleImage> run(const SceneFile& file) {
    const OpenScene scene = open_scene(file);
    SceneRun run(scene);
    std::vector<ObstacleImage> images;
    while (run.next()) images.push_back(run.frame()->obstacles);
    return images;
  }
};

TEST(CalibrateBackground, IsWhatARunLearnsFromTheSameImages) {
  const DrawnCell cell = right_cell();
  const std::vector<CalibratedBackground> calibrated = calibrate_cell(cell);
  ASSERT_EQ(calibrated.size(), 1U);
  EXPECT_EQ(calibrated[0].file, cell / "new.background.camera.png");
  EXPECT_GT(calibrated[0].known_share(), 0.3);
  EXPECT_LT(calibrated[0].known_share(), 1) << "the robot is somewhere in all images";
  const SceneFile scene = read_scene(cell / "new.yaml");
  EXPECT_EQ(scene.cameras[0].background, cell / "new.background.camera.png");
  EXPECT_EQ(scene.cameras[0].settings.sensor.background_frames, 3);
  // Images and background are whole millimetres both.
  const TwoRuns runs(scene);
  ASSERT_EQ(runs.named.size(), 4U);
  std::int64_t background = 0;
  for (std::size_t k = 0; k < runs.named.size(); ++k) {
    EXPECT_EQ(runs.named[k].fate.pixels(), runs.learned[k].fate.pixels());
    EXPECT_EQ(runs.named[k].count, runs.learned[k].count);
    background += runs.named[k].count_of(PixelFate::background);
    for (std::size_t i = 0; i < runs.named[k].depth_m.pixels().size(); ++i) {
      const float named_m = runs.named[k].depth_m.pixels()[i];
      const float learned_m = runs.learned[k].depth_m.pixels()[i];
      ASSERT_TRUE(named_m == learned_m || (std::isnan(named_m) && std::isnan(learned_m))) << i;
    }
  }
  EXPECT_GT(background, 1000);
}

TEST(CalibrateBackground, IsNeverFartherThanItWasMeasured) {
  const DrawnCell cell = right_cell({.depth_scale_m = 0.0007, .depth_offset_m = 0.0003});
  calibrate_cell(cell);
  const TwoRuns runs(read_scene(cell / "new.yaml"));
  int put = 0;
  for (std::size_t k = 0; k < runs.named.size(); ++k) {
    for (std::size_t i = 0; i < runs.named[k].depth_m.pixels().size(); ++i) {
      if (runs.named[k].fate.pixels()[i] != PixelFate::background) continue;
      ++put;
      const double nearer_m =
          double{runs.learned[k].depth_m.pixels()[i]} - runs.named[k].depth_m.pixels()[i];
      ASSERT_GT(nearer_m, -2e-6);
      ASSERT_LT(nearer_m, 0.001);
    }
  }
  EXPECT_GT(put, 100);
}

TEST(CalibrateBackground, TheScenesOwnNumberOfImagesStays) {
  const DrawnCell cell = right_cell({.more = "sensor: {background_frames: 2}\n"});
  const double share_of_two = calibrate_cell(cell)[0].known_share();
  EXPECT_EQ(read_scene(cell / "new.yaml").cameras[0].settings.sensor.background_frames, 2);
  EXPECT_GE(share_of_two, calibrate_cell(right_cell())[0].known_share());
  const DrawnCell many = right_cell({.more = "sensor: {background_frames: 9}\n"});
  EXPECT_EQ(why_none(many.scene(), many / "new.yaml"),
            "camera camera: no background was learned: 9 of its 4 images have to show a place "
            "alike, with the robot 0.15 m away");
}

TEST(CalibrateBackground, ACopyOfTheSceneElsewhereLeadsToTheSameFile) {
  const DrawnCell cell = right_cell();
  calibrate_cell(cell);
  std::filesystem::create_directory(cell / "other");
  write_rewritten_scene(cell / "new.yaml", {}, cell / "other/again.yaml");
  const SceneFile again = read_scene(cell / "other/again.yaml");
  EXPECT_TRUE(std::filesystem::equivalent(*again.cameras[0].background,
                                          cell / "new.background.camera.png"));
}

TEST(CalibrateBackground, ABadFileIsToldWhenTheSceneIsOpened) {
  const DrawnCell cell = right_cell();
  calibrate_cell(cell);
  const auto opened = [&] { return error_message([&] { open_scene(cell / "new.yaml"); }); };
  EXPECT_EQ(opened(), "");
  const std::filesystem::path file = cell / "new.background.camera.png";
  write_depth_png(file, DepthImage(80, 60, 2.0F), 0.001);
  expect_parts(opened(), {"new.background.camera.png", "80", "160"});
  write_link_ids_png(file, Image<LinkId>(160, 120, 7));
  expect_parts(opened(), {"new.background.camera.png", "8", "16"});
  write_file_bytes(file, "no image");
  expect_parts(opened(), {"new.background.camera.png"});
  std::filesystem::remove(file);
  expect_parts(opened(), {"new.background.camera.png"});
}

TEST(CalibrateBackground, AFileWithoutTheRuleIsRefused) {
  const DrawnCell cell = right_cell();
  calibrate_cell(cell);
  std::string text = read_file_bytes(cell / "new.yaml");
  const std::string rule = "background_frames: 3";
  ASSERT_NE(text.find(rule), std::string::npos);
  text.replace(text.find(rule), rule.size(), "background_frames: 0");
  cell.write("new.yaml", text);
  expect_parts(error_message([&] { read_scene(cell / "new.yaml"); }),
               {"new.yaml:", "cameras[0].background", "new.background.camera.png",
                "expected sensor.background_frames of 1 or more with it"});
}

TEST(CalibrateBackground, ACameraThatMovesHasNone) {
  const DrawnCell cell = right_cell({}, DrawnMount::hand);
  expect_parts(why_none(cell.scene(), cell / "new.yaml"),
               {"camera camera: no background was learned: moves with link \""});
}

TEST(CalibrateBackground, NoFileOfTheSceneIsOverwritten) {
  const DrawnCell cell = right_cell();
  expect_parts(why_none(cell.scene(), cell / "cell/depth/new.yaml"),
               {"cell/depth/new.background.camera.png would lie among the images of camera camera",
                "choose another folder"});
  calibrate_cell(cell);
  std::filesystem::rename(cell / "new.yaml", cell / "renamed.yaml");
  expect_parts(why_none(cell / "renamed.yaml", cell / "new.yaml"),
               {"new.background.camera.png is camera camera's in ", "never overwritten"});
}

}  // namespace
}  // namespace berth
