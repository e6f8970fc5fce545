// Which links meet which, and small cells whose distances to what is known are plain to see.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <map>
#include <numbers>

#include "berth/distance/known_distances.hpp"
#include "berth/robot/attachment.hpp"
#include "berth/robot/primitives.hpp"
#include "tests/support/error_message.hpp"
#include "tests/support/temporary_folder.hpp"

namespace berth {
namespace {

std::string box_link(const std::string& name, const Eigen::Vector3d& size_m, double centre_z_m) {
  return fmt::format(
      R"(<link name="{}"><visual><origin xyz="0 0 {}"/><geometry><box size="{} {} {}"/></geometry>)"
      R"(</visual></link>)",
      name, centre_z_m, size_m.x(), size_m.y(), size_m.z());
}

std::string joint(const std::string& parent, const std::string& child, const std::string& type,
                  const std::string& axis, const std::string& xyz) {
  return fmt::format(
      R"(<joint name="to_{1}" type="{2}"><parent link="{0}"/><child link="{1}"/>)"
      R"(<origin xyz="{4}"/><axis xyz="{3}"/><limit lower="-3" upper="3" velocity="1"/></joint>)",
      parent, child, type, axis, xyz);
}

/// A column of 0.5 m; an upper arm and a forearm turn about y and are upright at 0, a finger slides
/// along the forearm.
std::string arm_text(const std::string& prefix) {
  return box_link(prefix + "base", {0.2, 0.2, 0.5}, 0.25) +
         box_link(prefix + "upper", {0.08, 0.08, 0.4}, 0.2) +
         box_link(prefix + "forearm", {0.06, 0.06, 0.445}, 0.2225) +
         box_link(prefix + "finger", {0.02, 0.02, 0.1}, 0.05) +
         joint(prefix + "base", prefix + "upper", "revolute", "0 1 0", "0 0 0.5") +
         joint(prefix + "upper", prefix + "forearm", "revolute", "0 1 0", "0 0 0.4") +
         joint(prefix + "forearm", prefix + "finger", "prismatic", "0 0 1", "0 0 0.445");
}

/// An arm on a table, whose upper side is at 0.
std::string cell_text(const std::string& more = "") {
  return "<robot name=\"cell\">" + box_link("table", {3, 3, 0.4}, -0.2) + arm_text("") +
         joint("table", "base", "fixed", "0 0 1", "0 0 0") + more + "</robot>";
}

RobotSettings cell(const std::string& text = cell_text()) {
  return {.urdf = "cell.urdf", .environment_links = {"table"}, .urdf_text = text};
}

using Known = std::map<std::string, KnownPair>;

Known known_at(const RobotModel& model, const std::vector<double>& positions) {
  const auto known = build_known_model(model, build_robot_patches(model));
  RobotPose pose;
  forward_kinematics(model, positions, pose);
  KnownWorkspace workspace;
  std::vector<KnownPair> found;
  known_distances(*known, pose, {}, workspace, found);
  Known out;
  for (std::size_t i = 0; i < found.size(); ++i) {
    out[model.links[known->bodies[i].link].name] = found[i];
  }
  return out;
}

std::string other_of(const RobotModel& model, const KnownPair& pair) {
  return pair.is_known() ? model.links[static_cast<std::size_t>(pair.link)].name : "";
}

constexpr double kPi = std::numbers::pi;

TEST(KnownCell, AFinger25mmInsideTheTableIsAt0) {
  const RobotModel model = load_robot(cell());
  const Known found = known_at(model, {kPi / 2, kPi / 2, -0.02});
  EXPECT_EQ(found.at("finger").distance_m, 0);
  EXPECT_EQ(found.at("finger").lower_bound_m, 0);
  EXPECT_EQ(other_of(model, found.at("finger")), "table");
  EXPECT_NEAR(found.at("forearm").distance_m, 0.055, 1e-3);
  EXPECT_LE(found.at("forearm").lower_bound_m, 0.055);
  EXPECT_EQ(other_of(model, found.at("forearm")), "table");
}

TEST(KnownCell, AFingerWhollyInsideTheTableIsAt0) {
  const RobotModel model = load_robot(cell());
  const Known found = known_at(model, {kPi / 2, kPi / 2, 0.2});
  EXPECT_EQ(found.at("finger").distance_m, 0);
  EXPECT_EQ(other_of(model, found.at("finger")), "table");
  EXPECT_TRUE(found.at("finger").robot_point_B_m.isApprox(found.at("finger").obstacle_point_B_m));
}

TEST(KnownCell, AForearmFolded45mmIntoItsOwnBaseIsAt0) {
  const RobotModel model = load_robot(cell());
  const Known found = known_at(model, {0, kPi, 0});
  EXPECT_EQ(found.at("forearm").distance_m, 0);
  EXPECT_EQ(other_of(model, found.at("forearm")), "base");
}

TEST(KnownCell, ASecondArmIsWhereItIs) {
  RobotSettings one_file = cell(cell_text(
      arm_text("second_") + joint("table", "second_base", "fixed", "0 0 1", "0.626 0 0")));
  TemporaryFolder folder;
  std::ofstream(folder.path() / "arm.urdf") << "<robot name=\"arm\">" << arm_text("") << "</robot>";
  RobotSettings two_files = cell();
  two_files.others.push_back({.urdf = folder.path() / "arm.urdf",
                              .prefix = "second_",
                              .parent = "table",
                              .X_PR = Pose(Eigen::Translation3d(0.626, 0, 0))});
  for (const RobotSettings& settings : {one_file, two_files}) {
    const RobotModel model = load_robot(settings);
    ASSERT_EQ(model.joints.size(), 6u);
    const Known found = known_at(model, {0, 0, 0.3, 0, 0, 0.3});
    EXPECT_NEAR(found.at("upper").distance_m, 0.486, 1e-3);
    EXPECT_EQ(other_of(model, found.at("upper")), "second_base");
    EXPECT_NEAR(found.at("second_upper").distance_m, 0.486, 1e-3);
    EXPECT_TRUE(std::isnan(found.at("base").distance_m));
  }
}

TEST(KnownCell, NothingWithinTheRangeIsNoPair) {
  const RobotModel model = load_robot(cell());
  const Known found = known_at(model, {0, 0, 0.7});
  EXPECT_FALSE(found.at("finger").is_known());
  EXPECT_EQ(found.at("finger").lower_bound_m, 1);
}

/// By "link - other".
std::map<std::string, LeftOutReason> left_out(const RobotModel& model) {
  const auto known = build_known_model(model, build_robot_patches(model));
  std::map<std::string, LeftOutReason> reasons;
  for (const LeftOutPair& pair : known->left_out) {
    reasons[model.links[pair.link].name + " - " + model.links[pair.other].name] = pair.reason;
  }
  return reasons;
}

TEST(KnownModel, NeighboursAreLeftOut) {
  const std::map<std::string, LeftOutReason> expected = {
      {"upper - base", LeftOutReason::neighbours},
      {"upper - forearm", LeftOutReason::neighbours},
      {"forearm - finger", LeftOutReason::neighbours}};
  EXPECT_EQ(left_out(load_robot(cell())), expected);
}

TEST(KnownModel, ALinkWithoutShapesIsNoNeighbour) {
  // A frame lies between the forearm and what turns in it.
  const std::string more = "<link name=\"frame\"/>" + box_link("wheel", {0.04, 0.04, 0.04}, 0) +
                           joint("forearm", "frame", "fixed", "0 0 1", "0 0 0.1") +
                           joint("frame", "wheel", "revolute", "0 0 1", "0 0 0");
  EXPECT_EQ(left_out(load_robot(cell(cell_text(more)))).at("forearm - wheel"),
            LeftOutReason::neighbours);
}

TEST(KnownModel, PairsThatAlwaysTouchAreLeftOut) {
  // A core that turns within the upper arm's foot stands in the base's top in every pose.
  const std::string more = box_link("core", {0.02, 0.02, 0.06}, 0) +
                           joint("upper", "core", "revolute", "0 1 0", "0 0 0");
  const auto reasons = left_out(load_robot(cell(cell_text(more))));
  EXPECT_EQ(reasons.at("core - base"), LeftOutReason::always_touch);
  EXPECT_FALSE(reasons.contains("core - table"));
}

TEST(KnownModel, AllowedContactsAreLeftOut) {
  TemporaryFolder folder;
  const auto srdf = folder.path() / "cell.srdf";
  std::ofstream(srdf) << R"(<robot name="cell"><disable_collisions link1="base" link2="finger"/>)"
                      << R"(<disable_collisions link1="nobody" link2="finger"/></robot>)";
  RobotSettings settings = cell();
  settings.allowed_contacts = {{"finger", "table"}};
  settings.srdf = srdf;
  const auto reasons = left_out(load_robot(settings));
  EXPECT_EQ(reasons.at("finger - table"), LeftOutReason::allowed);
  EXPECT_EQ(reasons.at("finger - base"), LeftOutReason::srdf);
  settings.allowed_contacts = {{"finger", "tabel"}};
  expect_parts(error_message([&] { load_robot(settings); }),
               {"allowed_contacts: no link \"tabel\""});
  std::ofstream(srdf) << "<robot><disable_collisions link1=\"base\"/></robot>";
  expect_parts(error_message([&] { load_robot(settings); }), {"tabel"});
  settings.allowed_contacts = {};
  expect_parts(error_message([&] { load_robot(settings); }), {"expected link1 and link2"});
}

TEST(KnownModel, APartMayTouchWhatItLiesOnUntilItIsLifted) {
  Attachment part{.name = "part",
                  .link = "finger",
                  .mesh_A = make_box({0.1, 0.1, 0.03}),
                  .X_LA = Pose(Eigen::Translation3d(0, 0, 0.1)),
                  .is_link = true};
  const RobotModel model = load_robot(cell());
  const RobotModel lifted = with_attachment(model, part);
  const std::vector<double> on_table = {kPi / 2, kPi / 2, -0.06};
  EXPECT_EQ(known_at(lifted, on_table).at("part").distance_m, 0);
  EXPECT_EQ(left_out(lifted).at("finger - part"), LeftOutReason::fixed);
  part.may_touch = {"table"};
  const RobotModel lying = with_attachment(model, part);
  const KnownPair found = known_at(lying, on_table).at("part");
  EXPECT_NEAR(found.distance_m, 0.025, 1e-3);
  EXPECT_EQ(other_of(lying, found), "forearm");
  part.may_touch = {"tabel"};
  expect_parts(error_message<std::invalid_argument>([&] { with_attachment(model, part); }),
               {"may_touch"});
  part.may_touch = {"table"};
  part.is_link = false;
  expect_parts(error_message<std::invalid_argument>([&] { with_attachment(model, part); }),
               {"may_touch"});
}

TEST(OtherRobots, NamesHaveToDiffer) {
  TemporaryFolder folder;
  std::ofstream(folder.path() / "arm.urdf") << "<robot name=\"arm\">" << arm_text("") << "</robot>";
  RobotSettings settings = cell();
  settings.others.push_back({.urdf = folder.path() / "arm.urdf", .parent = "table"});
  expect_parts(error_message([&] { load_robot(settings); }), {"a second link \"base\""});
  settings.others[0].prefix = "b_";
  settings.others[0].parent = "floor";
  expect_parts(error_message([&] { load_robot(settings); }), {"no link \"floor\""});
}

TEST(MeshParts, EncloseWhatIsInAClosedPart) {
  TriangleMesh mesh = make_box({0.2, 0.2, 0.2});
  mesh.append(make_sphere(0.05), Eigen::Affine3d(Eigen::Translation3d(1, 0, 0)));
  const mesh::MeshParts closed(mesh);
  EXPECT_EQ(closed.corners_m().size(), 2u);
  EXPECT_TRUE(closed.enclose({0.09, -0.09, 0.05}));
  EXPECT_TRUE(closed.enclose({1.03, 0.01, 0}));
  EXPECT_FALSE(closed.enclose({0.11, 0, 0}));
  EXPECT_FALSE(closed.enclose({0.5, 0, 0}));
  mesh.triangles.erase(mesh.triangles.begin());
  EXPECT_FALSE(mesh::MeshParts(mesh).enclose({0, 0, 0}));
  EXPECT_TRUE(mesh::MeshParts(mesh).enclose({1, 0, 0}));
}

}  // namespace
}  // namespace berth
