// What real robots carry. One of them has a gripper that its URDF does not have.
#include <gtest/gtest.h>

#include <algorithm>
#include <map>

#include "berth/calibration/attached_parts.hpp"
#include "berth/files/file_bytes.hpp"
#include "berth/robot/mesh_file/mesh_file.hpp"
#include "berth/scene/scene_calibration.hpp"
#include "berth/scene/scene_run.hpp"
#include "lab/calibration/attached.hpp"
#include "tests/calibration/arms.hpp"
#include "tests/support/data_folder.hpp"
#include "tests/support/temporary_folder.hpp"

namespace berth {
namespace {

SceneFile recording(const std::string& name) {
  const std::filesystem::path file = data_folder() / "recordings" / name / "scene.yaml";
  return std::filesystem::exists(file) ? read_scene(file) : SceneFile{};
}

/// To what is occupied, by link, one for each result. What the camera draws beside the arm, and no
/// second one sees free, is unknown space.
using Distances = std::map<std::string, std::vector<double>>;

Distances distances_of(const SceneFile& file) {
  const OpenScene scene = open_scene(file);
  const std::vector<std::string> names = scene.robot->model().evaluated_link_names();
  Distances distances;
  SceneRun run(scene);
  while (run.next()) {
    for (const LinkResult& link : run.ask().links) {
      distances[names[link.id - 1]].push_back(link.occupied.distance_m);
    }
  }
  return distances;
}

TEST(AttachedRecordings, TheGripperOfTheKukaIsFoundAndItsLinksAreAsFarAsWithOneMadeByHand) {
  SceneFile scene = recording("lbr_med7_realsense");
  if (scene.cameras.empty()) GTEST_SKIP() << "no recording";
  const OpenScene open = open_scene(scene);
  const SceneCalibrationData material = make_calibration_data(open);
  const CalibrationResult found = calibrate(material.calibration_data);
  const AttachedParts attached = find_attached_parts(material.calibration_data, found);
  ASSERT_EQ(attached.parts.size(), 1U);
  const AttachedPart& part = attached.parts[0];
  EXPECT_EQ(part.link, "lbr_link_7");
  EXPECT_GE(part.places, 3);
  EXPECT_GT(part.explained_share, 0.7);
  EXPECT_LE(part.mesh_L.triangles.size(), 800U);

  scene.cameras[0].X_PC = found.cameras[0].X_PC;
  const Distances bare = distances_of(scene);
  const TemporaryFolder folder;
  SceneAttachment gripper;
  gripper.link = part.link;
  gripper.name = "gripper";
  gripper.mesh = folder.write("gripper.stl", stl_bytes(part.mesh_L));
  scene.attached = {gripper};
  const Distances with_found = distances_of(scene);
  // By the readings of it in images 0, 1, 3 and 5: round, 9.2 cm wide, 14.5 cm from the flange on.
  gripper.mesh.clear();
  gripper.cylinder_m = Eigen::Vector2d(0.046, 0.145);
  gripper.X_LA = Pose(Eigen::Translation3d(0, 0, 0.0725));
  scene.attached = {gripper};
  const Distances with_made = distances_of(scene);

  for (const auto& [link, made_m] : with_made) {
    for (std::size_t k = 0; k < made_m.size(); ++k) {
      EXPECT_NEAR(with_found.at(link)[k], made_m[k], 0.02) << link << " in result " << k;
    }
  }
  // Its own gripper is in contact with the hand, in the images that show it, and then it is not.
  for (const std::size_t k : {0U, 3U, 5U}) {
    EXPECT_LT(bare.at("lbr_link_7")[k], 0.05);
    EXPECT_GT(with_found.at("lbr_link_7")[k], 0.15);
  }
}

TEST(AttachedRecordings, RobotsThatCarryNothingHaveNoPart) {
  for (const char* name : {"xarm7_realsense", "lbr_med7_zed2i_small", "lbr_med7_zed2i"}) {
    SCOPED_TRACE(name);
    const SceneFile scene = recording(name);
    if (scene.cameras.empty()) GTEST_SKIP() << "no recording";
    const OpenScene open = open_scene(scene);
    const SceneCalibrationData material = make_calibration_data(open);
    const AttachedParts attached = find_attached_parts(
        material.calibration_data, calibrate(material.calibration_data, {.is_near = true}));
    EXPECT_TRUE(attached.parts.empty());
    EXPECT_EQ(attached.refused.empty(), std::string(name) != "lbr_med7_zed2i") << "it has 2 images";
  }
}

// Some of the cells of build/release/lab/measure_calibration --attached.

lab::AttachedTrial try_arm(sim::DrawnKind kind, int poses, int cameras) {
  return lab::try_attached(coarse_arm().model, coarse_arm().meshes, kind, poses, cameras, 1);
}

TEST(AttachedCells, WhatIsShownIsFoundAndNothingOfTheRoom) {
  for (const auto kind : {sim::DrawnKind::tool, sim::DrawnKind::bent_tool}) {
    const lab::AttachedTrial trial = try_arm(kind, 5, 3);
    ASSERT_GE(trial.poses_shown, 3);
    EXPECT_TRUE(trial.is_found);
    EXPECT_GT(trial.precision, 0.7);
    EXPECT_GT(trial.recall, 0.95);
    EXPECT_EQ(trial.false_parts, 0);
    EXPECT_EQ(trial.room_points, 0);
  }
}

TEST(AttachedCells, ARobotThatCarriesNothingHasNoPart) {
  EXPECT_EQ(try_arm(sim::DrawnKind::bare, 5, 3).parts, 0);
}

/// Each of these had a part where the share of what is explained was not asked for.
TEST(AttachedCells, WhatMovesOnItsOwnBesideTheRobotIsNoPartAndIsTold) {
  struct Case {
    sim::DrawnCompany company;
    int poses, cameras;
    std::uint32_t seed;
  };
  for (const Case& one :
       {Case{sim::DrawnCompany::follower, 5, 1, 1}, Case{sim::DrawnCompany::guide, 8, 2, 1},
        Case{sim::DrawnCompany::cart, 5, 1, 1}}) {
    SCOPED_TRACE(static_cast<int>(one.company));
    const AttachedParts found = lab::try_company(coarse_arm().model, coarse_arm().meshes,
                                                 one.company, one.poses, one.cameras, one.seed);
    EXPECT_TRUE(found.parts.empty());
    EXPECT_TRUE(found.refused.ends_with(
        "% of the readings that come and go near it fit none of its links; expected images in "
        "which nothing else moves"))
        << found.refused;
  }
}

}  // namespace
}  // namespace berth
