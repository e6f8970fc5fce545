#include "berth/calibration/attached_parts.hpp"

#include <gtest/gtest.h>

#include "berth/robot/primitives.hpp"
#include "sim/carrying_robot.hpp"
#include "sim/nearest_on_mesh.hpp"
#include "sim/shapes.hpp"
#include "sim/winding_number.hpp"
#include "tests/calibration/arms.hpp"

namespace berth {
namespace {

using Positions = std::vector<std::vector<double>>;

/// From `from_B_m` to a point before the arm.
Pose camera_at(const Eigen::Vector3d& from_B_m) {
  const Eigen::Vector3d z = (Eigen::Vector3d(0.2, 0, 0.5) - from_B_m).normalized();
  const Eigen::Vector3d x = z.cross(Eigen::Vector3d::UnitZ()).normalized();
  Pose X_BC = Pose::Identity();
  X_BC.linear() << x, z.cross(x), z;
  X_BC.translation() = from_B_m;
  return X_BC;
}

sim::DrawnObstacle box_at(const Eigen::Vector3d& size_m, const Eigen::Vector3d& p_B_m) {
  return {make_box(size_m), sim::translation(p_B_m.x(), p_B_m.y(), p_B_m.z())};
}

/// The wrist swings before the camera, and turns.
const Positions kPoses = {
    {0.0, 0.6, 0.0, 1.2, 0.0, 0.9, 0.0},   {0.7, 0.3, 0.2, 1.5, 0.6, 0.5, 0.9},
    {-0.6, 0.5, 0.0, 1.0, -0.8, 1.2, 2.0}, {0.3, 0.9, -0.4, 1.4, 1.2, -0.6, -1.2},
    {-0.9, 0.2, 0.3, 1.8, 0.4, 0.2, -2.2}, {0.5, 0.0, -0.2, 1.7, -1.5, 1.0, 1.5}};

sim::CarryingRobotSettings cell() {
  sim::CarryingRobotSettings settings;
  settings.positions = kPoses;
  settings.camera = {320, 240, 280, 280, 159.5, 119.5};
  settings.X_BC = {camera_at({1.9, 0.3, 0.9})};
  settings.room = {box_at({0.1, 6, 5}, {-1.5, 0, 1}), box_at({6, 6, 0.1}, {0, 0, -0.9})};
  return settings;
}

Attachment tool() {
  Attachment tool;
  tool.name = "tool";
  tool.link = "arm_link_7";
  tool.mesh_A = make_box({0.10, 0.06, 0.18});
  tool.X_LA = sim::translation(0.02, 0, 0.23);
  return tool;
}

/// The pose of the last link.
Pose hand_at(const std::vector<double>& positions) {
  RobotPose pose;
  forward_kinematics(coarse_arm().model, positions, pose);
  return pose.X_BL[*coarse_arm().model.find_link("arm_link_7")];
}

AttachedParts find(const sim::CarryingRobotSettings& settings, std::uint32_t seed = 1) {
  const sim::CarryingRobot drawn =
      sim::draw_carrying_robot(coarse_arm().model, coarse_arm().meshes, settings, seed);
  return find_attached_parts(drawn.calibration_data, drawn.found);
}

/// The one part that was found is the thing on its link: no point of its surface is farther than
/// `most_m` outside of the thing.
void expect_is(const AttachedParts& found, const Attachment& thing, double most_m) {
  EXPECT_EQ(found.refused, "");
  ASSERT_EQ(found.parts.size(), 1U);
  const AttachedPart& part = found.parts[0];
  EXPECT_EQ(part.link, thing.link);
  TriangleMesh thing_L;
  thing_L.append(thing.mesh_A, Eigen::Affine3d(thing.X_LA));
  const sim::NearestOnMesh to_thing(thing_L);
  const sim::NearestOnMesh to_part(part.mesh_L);
  for (const Eigen::Vector3f& vertex : part.mesh_L.vertices_m) {
    EXPECT_LT(to_thing(vertex.cast<double>()).distance_m, most_m) << vertex.transpose();
  }
  for (const Eigen::Vector3f& vertex : thing_L.vertices_m) {
    EXPECT_LT(to_part(vertex.cast<double>()).distance_m, most_m) << vertex.transpose();
  }
}

TEST(AttachedParts, AToolIsFound) {
  sim::CarryingRobotSettings settings = cell();
  settings.carried = {tool()};
  const AttachedParts found = find(settings);
  expect_is(found, tool(), 0.035);
  if (found.parts.empty()) return;
  const AttachedPart& part = found.parts[0];
  EXPECT_GE(part.places, 3);
  EXPECT_GT(part.explained_share, 0.95);
  EXPECT_LE(part.explained_share, 1);
  EXPECT_LT(part.padding_m, 0.02);
}

TEST(AttachedParts, ARobotThatCarriesNothingHasNoPart) {
  for (const std::uint32_t seed : {1U, 2U}) {
    const AttachedParts found = find(cell(), seed);
    EXPECT_EQ(found.refused, "");
    EXPECT_TRUE(found.parts.empty());
  }
}

TEST(AttachedParts, ABoxInTheMiddleOfTheArmBelongsToItsOwnLink) {
  Attachment box;
  box.name = "cable box";
  box.link = "arm_link_3";
  box.mesh_A = make_box({0.10, 0.12, 0.12});
  box.X_LA = sim::translation(0.13, 0, 0.1);
  sim::CarryingRobotSettings settings = cell();
  settings.carried = {box};
  settings.X_BC.push_back(camera_at({0.4, -1.8, 0.8}));
  expect_is(find(settings), box, 0.04);
}

TEST(AttachedParts, WhatTwoLinksExplainAlikeBelongsToTheOneNearerToTheTip) {
  sim::CarryingRobotSettings settings = cell();
  settings.carried = {tool()};
  for (std::vector<double>& positions : settings.positions) positions.back() = 0.4;
  expect_is(find(settings), tool(), 0.035);
}

/// What stands in the room, and looks the same to a link in all poses.
TEST(AttachedParts, ATableUnderALinkThatNeverMovesAgainstItIsNoPart) {
  sim::CarryingRobotSettings settings = cell();
  // The hand swings at one height, 3 cm above a plate.
  settings.positions.clear();
  for (const double turn : {-1.0, -0.6, -0.2, 0.2, 0.6, 1.0}) {
    settings.positions.push_back({turn, 1.0, 0, 1.2, 0, 0.941592654, 0});
  }
  const double tip_m = (hand_at(settings.positions[0]) * Eigen::Vector3d(0, 0, 0.141)).z();
  settings.room.push_back(box_at({1.6, 2.4, 0.02}, {0.4, 0, tip_m - 0.04}));
  settings.X_BC.push_back(camera_at({0.9, -1.8, 1.4}));
  EXPECT_TRUE(find(settings).parts.empty());
}

TEST(AttachedParts, APostThatHugsTheArmInAllPosesIsNoPart) {
  // Round, and about the axis of joint 1: it looks the same from link 1 however that turns.
  const auto collar = [](double radius_m, double z_m) {
    return sim::DrawnObstacle{make_cylinder(radius_m, 0.2), sim::translation(0, 0, z_m)};
  };
  sim::CarryingRobotSettings settings = cell();
  settings.room.push_back(collar(0.19, 0.2));
  settings.room.push_back(box_at({0.08, 0.08, 1.2}, {0.05, 0.28, 0.5}));
  settings.X_BC.push_back(camera_at({0.4, -1.8, 0.8}));
  EXPECT_TRUE(find(settings).parts.empty());
  settings.carried = {tool()};
  expect_is(find(settings), tool(), 0.035);
}

TEST(AttachedParts, AThingThatIsLetGoIsNoPart) {
  sim::CarryingRobotSettings settings = cell();
  for (std::size_t k = 0; k < settings.positions.size(); ++k) {
    const Pose X_BO =
        k < 3 ? hand_at(settings.positions[k]) * tool().X_LA : sim::translation(0.2, 0.9, 0.1);
    settings.in_pose.push_back({{tool().mesh_A, X_BO}});
  }
  EXPECT_TRUE(find(settings).parts.empty()) << "its place in the hand was seen free later";
}

TEST(AttachedParts, TooFewPosesAreRefused) {
  sim::CarryingRobotSettings settings = cell();
  settings.carried = {tool()};
  settings.positions.resize(4);
  settings.positions.push_back(settings.positions.back());
  const AttachedParts found = find(settings);
  EXPECT_TRUE(found.parts.empty());
  EXPECT_EQ(found.refused,
            "what the robot carries was not looked for: 4 different poses of the arm; expected 5 "
            "or more");
}

TEST(AttachedParts, ACameraWhosePoseWasNotFoundIsNotAsked) {
  sim::CarryingRobotSettings settings = cell();
  settings.carried = {tool()};
  sim::CarryingRobot drawn =
      sim::draw_carrying_robot(coarse_arm().model, coarse_arm().meshes, settings, 1);
  drawn.found.cameras[0].is_found = false;
  EXPECT_EQ(find_attached_parts(drawn.calibration_data, drawn.found).refused,
            "what the robot carries was not looked for: 0 different poses of the arm; expected 5 "
            "or more");
}

TEST(AttachedParts, APartThatFewPosesShowIsNotTaken) {
  // Boards close to the camera hide the tool in all poses but two, or three.
  for (const std::size_t shown : {2U, 3U}) {
    SCOPED_TRACE(shown);
    sim::CarryingRobotSettings settings = cell();
    settings.carried = {tool()};
    // The same sides of it are seen.
    settings.positions[1] = {0.5, 0.5, 0, 1.2, 0, 0.9, 0};
    settings.positions[2] = {-0.5, 0.5, 0, 1.1, 0, 0.9, 0};
    settings.in_pose.resize(settings.positions.size());
    for (std::size_t k = shown; k < settings.positions.size(); ++k) {
      const Eigen::Vector3d tool_B_m = hand_at(settings.positions[k]) * tool().X_LA.translation();
      const Eigen::Vector3d to_camera = settings.X_BC[0].translation() - tool_B_m;
      settings.in_pose[k] = {box_at({0.01, 0.06, 0.06}, tool_B_m + 0.9 * to_camera)};
    }
    EXPECT_EQ(find(settings).parts.size(), shown < 3 ? 0U : 1U);
  }
}

TEST(AttachedParts, WhatWasSeenFreeInTheBendOfAToolIsNoPartOfIt) {
  Attachment bent = tool();
  bent.mesh_A = make_box({0.05, 0.06, 0.20});
  bent.mesh_A.append(make_box({0.20, 0.06, 0.05}),
                     Eigen::Affine3d(Eigen::Translation3d(0.10, 0, 0.10)));
  bent.X_LA = sim::translation(0, 0, 0.24);
  sim::CarryingRobotSettings settings = cell();
  settings.carried = {bent};
  settings.X_BC.push_back(camera_at({0.4, -1.8, 0.8}));
  const AttachedParts found = find(settings);
  ASSERT_EQ(found.parts.size(), 1U);
  const TriangleMesh& mesh_L = found.parts[0].mesh_L;
  EXPECT_NEAR(sim::winding_number(mesh_L, {0, 0, 0.28}), 1, 1e-3) << "in the stem";
  EXPECT_NEAR(sim::winding_number(mesh_L, {0.15, 0, 0.34}), 1, 1e-3) << "in the arm";
  // 6 cm from both, and within the hull.
  EXPECT_NEAR(sim::winding_number(mesh_L, {0.085, 0, 0.255}), 0, 1e-3);
}

TEST(AttachedParts, ACameraWhosePoseIsOffMakesNothingMoveForAnotherOne) {
  // A round collar about joint 1: cameras that do not agree where it stands see it free in turn.
  sim::CarryingRobotSettings settings = cell();
  settings.positions.clear();
  for (const double turn : {-1.0, -0.6, -0.2, 0.2, 0.6, 1.0}) {
    settings.positions.push_back({turn, 0.3, 0, 1.2, 0, 0.9, 0});
  }
  settings.room.push_back({make_cylinder(0.25, 0.3), sim::translation(0, 0, 0.25)});
  settings.X_BC.push_back(camera_at({1.5, -1.2, 0.9}));
  sim::CarryingRobot drawn =
      sim::draw_carrying_robot(coarse_arm().model, coarse_arm().meshes, settings, 1);
  drawn.found.cameras[1].X_PC.translation() += Eigen::Vector3d(0.03, -0.03, 0.02);
  EXPECT_TRUE(find_attached_parts(drawn.calibration_data, drawn.found).parts.empty());
}

TEST(AttachedParts, APartThatMovesByLessThanItsLengthIsNotTaken) {
  Attachment rod = tool();
  rod.mesh_A = make_box({0.06, 0.04, 0.34});
  rod.X_LA = sim::translation(0, 0, 0.31);
  sim::CarryingRobotSettings settings = cell();
  settings.carried = {rod};
  // Sideways: each place is free in the next image.
  for (const double step : {0.10, 0.30}) {
    SCOPED_TRACE(step);
    settings.positions.clear();
    for (int k = 0; k < 5; ++k) settings.positions.push_back({step * k, 0.6, 0, 1.2, 0, 0.9, 0});
    EXPECT_EQ(find(settings).parts.size(), step > 0.2 ? 1U : 0U);
  }
}

}  // namespace
}  // namespace berth
