// What a valid URDF becomes. Broken ones: urdf_error_test.cpp; poses: kinematics_test.cpp.
#include <gtest/gtest.h>

#include <limits>
#include <numbers>

#include "berth/robot/kinematics.hpp"
#include "berth/robot/primitives.hpp"
#include "berth/robot/robot_model.hpp"
#include "tests/robot/error_text.hpp"
#include "tests/robot/mesh_writing.hpp"
#include "tests/robot/robot_text.hpp"
#include "tests/support/error_message.hpp"

namespace berth {
namespace {

RobotModel load(const std::string& xml, const RobotSettings& settings = {}) {
  const TemporaryFolder folder;
  return load_text(folder, xml, settings);
}

Eigen::AlignedBox3f box_of(const RobotModel& model, const std::string& link) {
  return model.links.at(model.find_link(link).value()).mesh_L.bounding_box_m();
}

void expect_box(const Eigen::AlignedBox3f& box, const Eigen::Vector3f& min,
                const Eigen::Vector3f& max, float tolerance_m = 1e-6F) {
  EXPECT_LE((box.min() - min).cwiseAbs().maxCoeff(), tolerance_m) << box.min().transpose();
  EXPECT_LE((box.max() - max).cwiseAbs().maxCoeff(), tolerance_m) << box.max().transpose();
}

/// base -> left -> tip, base -> right; joints named after their child.
std::string tree_xml(const std::string& left_joint = "revolute",
                     const std::string& right_joint = "prismatic") {
  return robot_xml(box_link_xml("tip") + box_link_xml("right") + box_link_xml("left") +
                   box_link_xml("base") + joint_xml("to_tip", "continuous", "left", "tip") +
                   joint_xml("to_left", left_joint, "base", "left") +
                   joint_xml("to_right", right_joint, "base", "right"));
}

TEST(Urdf, LinksFollowTheTreeParentsFirst) {
  const RobotModel model = load(tree_xml());
  EXPECT_EQ(model.name, "test");
  ASSERT_EQ(model.links.size(), 4U);
  EXPECT_EQ(model.links[0].name, "base");
  EXPECT_FALSE(model.links[0].parent);
  for (std::size_t i = 1; i < model.links.size(); ++i) EXPECT_LT(model.links[i].parent.value(), i);
  EXPECT_EQ(model.links[model.links[*model.find_link("tip")].parent.value()].name, "left");
  EXPECT_FALSE(model.find_link("nobody"));
}

TEST(Urdf, IdsCountTheEvaluatedLinksInTheOrderOfTheLinks) {
  const RobotModel model = load(tree_xml());
  ASSERT_EQ(model.link_count(), 4);
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_EQ(model.evaluated_links[i], i);
    EXPECT_EQ(model.links[i].id, i + 1);
    EXPECT_EQ(model.links[i].role, LinkRole::evaluated);
    EXPECT_EQ(model.evaluated_link_names()[i], model.links[i].name);
  }
}

TEST(Urdf, JointsCarryTheirLimitsAndContinuousOnesHaveNone) {
  const RobotModel model = load(tree_xml());
  ASSERT_EQ(model.joints.size(), 3U);
  for (const MovableJoint& joint : model.joints) {
    const bool is_free = joint.type == JointType::continuous;
    EXPECT_EQ(joint.upper, is_free ? std::numeric_limits<double>::infinity() : 9) << joint.name;
    EXPECT_EQ(joint.lower, -joint.upper) << joint.name;
  }
}

TEST(Urdf, EveryJointTypeIsKnownAndFixedOnesHaveNoPosition) {
  for (const auto& [text, type] : {std::pair{"revolute", JointType::revolute},
                                   {"continuous", JointType::continuous},
                                   {"prismatic", JointType::prismatic}}) {
    const RobotModel model = load(tree_xml(text, "fixed"));
    ASSERT_EQ(model.joints.size(), 2U);
    const Joint& joint = model.links[*model.find_link("left")].joint;
    EXPECT_EQ(joint.type, type);
    EXPECT_EQ(model.joints[joint.position_index.value()].name, "to_left");
    EXPECT_EQ(model.joints[*joint.position_index].type, type);
    const Joint& fixed = model.links[*model.find_link("right")].joint;
    EXPECT_EQ(fixed.type, JointType::fixed);
    EXPECT_FALSE(fixed.position_index);
  }
}

TEST(Urdf, AxisIsOfUnitLengthAndXWithoutOne) {
  const RobotModel model =
      load(robot_xml(box_link_xml("base") + link_xml("a") + link_xml("b") +
                     joint_xml("to_a", "revolute", "base", "a", R"(<axis xyz="0 -3 4"/>)") +
                     joint_xml("to_b", "revolute", "base", "b")));
  EXPECT_TRUE(model.links[*model.find_link("a")].joint.axis_J.isApprox(
      Eigen::Vector3d(0, -0.6, 0.8), 1e-12));
  EXPECT_EQ(model.links[*model.find_link("b")].joint.axis_J, Eigen::Vector3d::UnitX());
}

TEST(Urdf, MimicJointFollowsItsMasterThroughAChain) {
  const std::string mimic_a = R"(<mimic joint="to_a" multiplier="-2" offset="0.5"/>)";
  const std::string mimic_b = R"(<mimic joint="to_b" multiplier="3" offset="1"/>)";
  const RobotModel model =
      load(robot_xml(box_link_xml("base") + link_xml("a") + link_xml("b") + link_xml("c") +
                     link_xml("d") + joint_xml("to_c", "revolute", "base", "c", mimic_b) +
                     joint_xml("to_b", "revolute", "base", "b", mimic_a) +
                     joint_xml("to_a", "revolute", "base", "a") +
                     joint_xml("to_d", "revolute", "base", "d", R"(<mimic joint="to_a"/>)")));
  ASSERT_EQ(model.joints.size(), 1U);
  EXPECT_EQ(model.joints[0].name, "to_a");
  EXPECT_EQ(model.mimic_joints.size(), 3U);
  const auto joint = [&](const char* link) { return model.links[*model.find_link(link)].joint; };
  EXPECT_EQ(joint("b").position_index, 0U);
  EXPECT_DOUBLE_EQ(joint("b").multiplier, -2);
  EXPECT_DOUBLE_EQ(joint("b").offset, 0.5);
  EXPECT_EQ(joint("c").position_index, 0U);
  EXPECT_DOUBLE_EQ(joint("c").multiplier, -6);
  EXPECT_DOUBLE_EQ(joint("c").offset, 3 * 0.5 + 1);
  EXPECT_DOUBLE_EQ(joint("d").multiplier, 1);
  EXPECT_DOUBLE_EQ(joint("d").offset, 0);
}

TEST(Urdf, ShapesOfALinkAreJoinedInItsFrame) {
  const std::string shapes = shape_xml(R"(<box size="2 4 6"/>)",
                                       R"(<origin xyz="10 0 0" rpy="0 0 1.5707963267948966"/>)") +
                             shape_xml(R"(<box size="1 1 1"/>)", R"(<origin xyz="0 0 -5"/>)");
  const RobotModel model = load(robot_xml(link_xml("base", shapes)));
  expect_box(box_of(model, "base"), {-0.5F, -1, -5.5F}, {12, 1, 3});
  EXPECT_EQ(model.links[0].mesh_L.triangles.size(), 24U);
}

TEST(Urdf, RpyTurnsAroundTheFixedAxesXThenYThenZ) {
  // The box's long side x stays x after the roll, becomes -z after the pitch and stays it.
  const std::string origin = R"(<origin xyz="0 0 0" rpy="0 1.5707963267948966 0.7"/>)";
  const RobotModel pitch =
      load(robot_xml(link_xml("base", shape_xml(R"(<box size="8 1e-6 1e-6"/>)", origin))));
  expect_box(box_of(pitch, "base"), {0, 0, -4}, {0, 0, 4}, 1e-5F);
  // z -> -y by the roll, then x by the yaw: the other order leaves it at z or y.
  const std::string roll_yaw = R"(<origin rpy="1.5707963267948966 0 1.5707963267948966"/>)";
  const RobotModel rolled =
      load(robot_xml(link_xml("base", shape_xml(R"(<box size="1e-6 1e-6 8"/>)", roll_yaw))));
  expect_box(box_of(rolled, "base"), {-4, 0, 0}, {4, 0, 0}, 1e-5F);
}

TEST(Urdf, PrimitivesHaveTheirSizeUpToTheStatedExcess) {
  const RobotModel model =
      load(robot_xml(link_xml("base", shape_xml(R"(<cylinder radius="0.5" length="3"/>)")) +
                     link_xml("ball", shape_xml(R"(<sphere radius="2"/>)")) +
                     joint_xml("to_ball", "fixed", "base", "ball")));
  const float cylinder_excess = static_cast<float>(0.5 * kMaxPrimitiveExcess);
  expect_box(box_of(model, "base"), {-0.5F, -0.5F, -1.5F}, {0.5F, 0.5F, 1.5F}, cylinder_excess);
  expect_box(box_of(model, "ball"), {-2, -2, -2}, {2, 2, 2},
             static_cast<float>(2 * kMaxPrimitiveExcess));
}

TEST(Urdf, ALinkWithShapesOfOneKindAloneIsTakenWithThese) {
  const std::string xml =
      robot_xml(link_xml("base", shape_xml(R"(<box size="1 1 1"/>)") +
                                     shape_xml(R"(<box size="2 2 2"/>)", "", "collision") +
                                     shape_xml(R"(<box size="4 1 1"/>)", "", "collision")) +
                box_link_xml("seen") +
                link_xml("hidden", shape_xml(R"(<box size="1 1 1"/>)", R"(<origin xyz="4 0 0"/>)",
                                             "collision")) +
                joint_xml("to_seen", "fixed", "base", "seen") +
                joint_xml("to_hidden", "fixed", "base", "hidden"));
  const RobotModel visual = load(xml);
  expect_box(box_of(visual, "base"), {-0.5F, -0.5F, -0.5F}, {0.5F, 0.5F, 0.5F});
  expect_box(box_of(visual, "hidden"), {3.5F, -0.5F, -0.5F}, {4.5F, 0.5F, 0.5F});
  ASSERT_EQ(visual.warnings.size(), 1U);
  expect_parts(visual.warnings[0], {"robot.urdf", "collision shape", "hidden", "ignore_links"});

  const RobotModel collision = load(xml, {.geometry = GeometryKind::collision});
  expect_box(box_of(collision, "base"), {-2, -1, -1}, {2, 1, 1});
  expect_box(box_of(collision, "seen"), {-0.5F, -0.5F, -0.5F}, {0.5F, 0.5F, 0.5F});
  expect_box(box_of(collision, "hidden"), {3.5F, -0.5F, -0.5F}, {4.5F, 0.5F, 0.5F});
}

/// A link "base", and one that is fixed to it.
RobotModel load_pair(const std::string& link, const RobotSettings& settings = {}) {
  return load(robot_xml(box_link_xml("base") + link + joint_xml("j", "fixed", "base", "second")),
              settings);
}

TEST(Urdf, ACollisionShapeAroundAVisibleLinkIsLeftOut) {
  // As Franka's link1_sc: a coarser shape of the same body.
  const std::string hull =
      link_xml("second", shape_xml(R"(<box size="1.3 1.3 1.3"/>)", "", "collision"));
  const RobotModel model = load_pair(hull);
  EXPECT_EQ(model.evaluated_link_names(), std::vector<std::string>{"base"});
  ASSERT_EQ(model.warnings.size(), 1U);
  expect_parts(model.warnings[0], {"around other links", "second"});
  EXPECT_EQ(load_pair(hull, {.environment_links = {"second"}}).links[1].id, kEnvironmentLink);
}

TEST(Urdf, AVisualShapeThatIsSeenThroughIsNoBody) {
  const auto zone = [](const char* rgba, const std::string& collision = "") {
    return link_xml("second", std::string("<visual><geometry><box size=\"9 9 9\"/></geometry>"
                                          "<material name=\"m\"><color rgba=\"") +
                                  rgba + "\"/></material></visual>" + collision);
  };
  const auto is_body = [](const RobotModel& model) { return !model.links[1].mesh_L.empty(); };
  const RobotModel model = load_pair(zone("0 1 0 0.3"));
  EXPECT_FALSE(is_body(model));
  ASSERT_EQ(model.warnings.size(), 1U);
  expect_parts(model.warnings[0], {"see-through", "second", "alpha"});
  EXPECT_TRUE(is_body(load_pair(zone("0 1 0 1"))));
  EXPECT_TRUE(is_body(load_pair(zone("0 1 0 0.9"))));
  EXPECT_TRUE(is_body(load_pair(zone("0 1 0"))));
  EXPECT_TRUE(
      is_body(load_pair(zone("0 1 0 0.3", shape_xml(R"(<box size="9 9 9"/>)", "", "collision")))));
  EXPECT_TRUE(is_body(load_pair(zone("0 1 0 0.3"), {.environment_links = {"second"}})));
  // A robot that is drawn see-through as a whole.
  EXPECT_EQ(load(robot_xml(zone("0 1 0 0.3"))).link_count(), 1);
}

TEST(Urdf, WhatNobodyNeedsMayBeBroken) {
  const RobotModel model =
      load("<robot name=\"test\" version=\"1.2\"><material name=\"m\"/><material name=\"m\"/>" +
           link_xml("base", shape_xml(R"(<box size="1 1 1"/>)") +
                                "<inertial><origin xyz=\"0 0 0\"/></inertial>" +
                                shape_xml("<capsule/>", "", "collision")) +
           box_link_xml("child") +
           joint_xml("turn", "revolute", "base", "child",
                     "<dynamics damping=\"x\"/><safety_controller/><calibration/>") +
           "<transmission/><gazebo/></robot>");
  EXPECT_EQ(model.link_count(), 2);
  EXPECT_EQ(model.joints.size(), 1U);
  EXPECT_EQ(model.joints[0].max_speed, 1);
}

TEST(Urdf, ReadsCapsulesAndQuaternions) {
  const RobotModel model = load(
      robot_xml(link_xml("base", shape_xml(R"(<capsule radius="0.1" length="1"/>)",
                                           R"(<origin quat_xyzw="0 0.70710678 0 0.70710678"/>)"))));
  expect_box(box_of(model, "base"), {-0.6F, -0.1F, -0.1F}, {0.6F, 0.1F, 0.1F}, 1e-3F);
}

TEST(Urdf, AMimicInAFixedJointIsNone) {
  const RobotModel model =
      load(robot_xml(box_link_xml("base") + box_link_xml("a") + box_link_xml("b") +
                     joint_xml("ja", "fixed", "base", "a") +
                     joint_xml("jb", "fixed", "base", "b", R"(<mimic joint="ja"/>)")));
  EXPECT_TRUE(model.joints.empty());
  EXPECT_TRUE(model.mimic_joints.empty());
}

TEST(Urdf, AFloatingJointBetweenWorldAndRobotIsFixed) {
  for (const char* type : {"floating", "planar"}) {
    const RobotModel model =
        load(robot_xml(link_xml("world") + box_link_xml("base") +
                       joint_xml("free", type, "world", "base", R"(<origin xyz="0 0 2"/>)")));
    EXPECT_TRUE(model.joints.empty());
    EXPECT_EQ(model.links[1].joint.X_PJ.translation().z(), 2);
    ASSERT_EQ(model.warnings.size(), 1U);
    expect_parts(model.warnings[0], {"\"free\"", "fixed"});
  }
}

TEST(Urdf, EnvironmentThatJointsMoveIsTold) {
  const RobotModel model = load(tree_xml(), {.environment_links = {"tip"}});
  ASSERT_EQ(model.warnings.size(), 1U);
  expect_parts(model.warnings[0], {"environment_links", "tip"});
}

/// The width of the mesh that base shows.
float width_of(const TemporaryFolder& folder, const std::string& name,
               RobotSettings settings = {}) {
  const RobotModel model =
      load_text(folder, robot_xml(link_xml("base", shape_xml("<mesh filename=\"" + name + "\"/>"))),
                settings);
  return box_of(model, "base").sizes().x();
}

TEST(Urdf, FindsAPackageByItsManifestAndFilesThatAreElsewhere) {
  const TemporaryFolder folder;
  const std::string mesh = binary_stl(two_triangles());
  folder.write("arm_description-main/package.xml",
               "<package><name>arm_description</name></package>");
  folder.write("arm_description-main/meshes/my part.stl", mesh);
  const float width = width_of(folder, "arm_description-main/meshes/my part.stl");
  EXPECT_EQ(width_of(folder, "package://arm_description/meshes/my part.stl"), width);
  EXPECT_EQ(width_of(folder, "package://arm_description/meshes/my%20part.stl"), width);
  EXPECT_EQ(width_of(folder, "model://arm_description/meshes/my part.stl"), width);
  const RobotSettings settings{
      .package_paths = {{"arm_description", folder / "arm_description-main"}}};
  const std::string elsewhere = "file:///home/other/ws/src/arm_description/meshes/my%20part.stl";
  EXPECT_EQ(width_of(folder, elsewhere, settings), width);
  expect_parts(error_message([&] { width_of(folder, elsewhere); }),
               {"/home/other/ws/src/arm_description", "No such file", "package_paths"});
}

TEST(Urdf, MeshIsScaledThenPlaced) {
  const TemporaryFolder folder;
  folder.write("part.stl", binary_stl(two_triangles()));
  const auto box = [&](const std::string& scale) {
    const std::string mesh = R"(<mesh filename="part.stl" scale=")" + scale + R"("/>)";
    return box_of(load_text(folder, robot_xml(link_xml(
                                        "base", shape_xml(mesh, R"(<origin xyz="10 0 0"/>)")))),
                  "base");
  };
  expect_box(box("1 1 1"), {10, 0, 0}, {11, 2, 3});
  expect_box(box("0.001 0.001 0.001"), {10, 0, 0}, {10.001F, 0.002F, 0.003F});
  expect_box(box("1 -2 3"), {10, -4, 0}, {11, 0, 9});
  expect_box(box("-1 -1 -1"), {9, -2, -3}, {10, 0, 0});
}

TEST(Urdf, MeshPathsAreRelativeOrAbsoluteOrOfAPackage) {
  const TemporaryFolder folder;
  const auto file = folder.write("here/my_robot/meshes/part.stl", binary_stl(two_triangles()));
  folder.write("elsewhere/meshes/part.stl", binary_stl({two_triangles()[0]}));
  const auto triangles = [&](const std::string& name, const RobotSettings& settings = {}) {
    RobotSettings with_urdf = settings;
    with_urdf.urdf =
        folder.write("here/my_robot/urdf/robot.urdf",
                     robot_xml(link_xml("base", shape_xml("<mesh filename=\"" + name + "\"/>"))));
    return load_robot(with_urdf).links[0].mesh_L.triangles.size();
  };
  EXPECT_EQ(triangles("../meshes/part.stl"), 2U);
  EXPECT_EQ(triangles(file.string()), 2U);
  EXPECT_EQ(triangles("file://" + file.string()), 2U);
  EXPECT_EQ(triangles("package://my_robot/meshes/part.stl"), 2U);
  EXPECT_EQ(triangles("package://my_robot/meshes/part.stl",
                      {.package_paths = {{"my_robot", folder.path() / "elsewhere"}}}),
            1U);
  EXPECT_EQ(triangles("package://other/meshes/part.stl",
                      {.package_paths = {{"other", folder.path() / "elsewhere"}}}),
            1U);
}

TEST(Urdf, TheTextMayComeFromNoFile) {
  const RobotModel model =
      load_robot({.urdf = "robot_description", .urdf_text = robot_xml(box_link_xml("base"))});
  EXPECT_EQ(model.link_count(), 1);
  expect_parts(
      error_message([] { load_robot({.urdf = "robot_description", .urdf_text = "<robot>"}); }),
      {"robot_description"});
}

TEST(Urdf, EnvironmentAndIgnoredLinksAreNotCounted) {
  const RobotModel model =
      load(tree_xml(), {.environment_links = {"base"}, .ignore_links = {"left"}});
  const Link& base = model.links[*model.find_link("base")];
  EXPECT_EQ(base.role, LinkRole::environment);
  EXPECT_EQ(base.id, kEnvironmentLink);
  EXPECT_FALSE(base.mesh_L.empty());
  const Link& left = model.links[*model.find_link("left")];
  EXPECT_EQ(left.role, LinkRole::ignored);
  EXPECT_EQ(left.id, kNoLink);
  EXPECT_TRUE(left.mesh_L.empty());
  ASSERT_EQ(model.link_count(), 2);
  EXPECT_EQ(model.links[*model.find_link("tip")].id, 1);
  EXPECT_EQ(model.links[*model.find_link("right")].id, 2);
  EXPECT_EQ(model.joints.size(), 3U) << "an ignored link still carries its children";
}

TEST(Urdf, AGuardedLinkIsABoxAndNoPartOfTheRobot) {
  const RobotModel model = load(tree_xml("revolute", "fixed"), {.guarded_links = {"right"}});
  EXPECT_EQ(model.links[*model.find_link("right")].role, LinkRole::ignored);
  EXPECT_EQ(model.link_count(), 3);
  ASSERT_EQ(model.guarded.size(), 1U);
  RobotPose pose;
  forward_kinematics(model, std::vector<double>(model.joints.size(), 0.3), pose);
  const RobotModel evaluated = load(tree_xml("revolute", "fixed"));
  const std::size_t right = *evaluated.find_link("right");
  for (const auto& corner_L_m : evaluated.links[right].mesh_L.vertices_m) {
    const Eigen::Vector3d p_B_m = pose.X_BL[right] * corner_L_m.cast<double>();
    const Eigen::Vector3d middle_m = model.guarded[0].X_BG.translation();
    EXPECT_TRUE(model.guarded[0].holds(middle_m + 0.999 * (p_B_m - middle_m)));
    EXPECT_FALSE(model.guarded[0].holds(middle_m + 1.001 * (p_B_m - middle_m)));
  }
}

TEST(Urdf, AGuardedLinkMayBeEnvironmentToo) {
  const RobotModel model =
      load(tree_xml(), {.environment_links = {"base"}, .guarded_links = {"base"}});
  EXPECT_EQ(model.links[0].role, LinkRole::environment);
  EXPECT_EQ(model.guarded.size(), 1U);
}

TEST(Urdf, MeshOfAnIgnoredLinkMayBeMissing) {
  const std::string xml =
      robot_xml(box_link_xml("base") +
                link_xml("lost", shape_xml(R"(<mesh filename="package://gone/part.stl"/>)")) +
                joint_xml("to_lost", "fixed", "base", "lost"));
  EXPECT_EQ(load(xml, {.ignore_links = {"lost"}}).link_count(), 1);
}

// The invalid URDFs that Debian's package dart-doc ships, where it is installed: each is refused by
// name.

struct Broken {
  std::string file;
  std::string told;
};

void PrintTo(const Broken& broken, std::ostream* out) { *out << broken.file; }

class DartRobot : public testing::TestWithParam<Broken> {};

TEST_P(DartRobot, IsRefusedByName) {
  const std::filesystem::path folder = "/usr/share/doc/dart/data/urdf/test";
  if (!std::filesystem::exists(folder)) GTEST_SKIP() << "needs Debian's package dart-doc";
  const auto file = folder / (GetParam().file + ".urdf");
  expect_error([&] { load_robot({.urdf = file}); }, {file.string(), GetParam().told});
}

INSTANTIATE_TEST_SUITE_P(
    Invalid, DartRobot,
    testing::Values(Broken{"invalid", "not a valid URDF"},
                    Broken{"invalid_mesh", "invalid_mesh.stl"},
                    Broken{"missing_mesh", "this_file_does_not_exist.stl"},
                    Broken{"missing_package", "package://missing_package/foo.stl"},
                    Broken{"primitive_geometry", "holds 3 shapes; expected one"},
                    Broken{"testWorld", "the root is <world>; expected <robot>"}),
    [](const auto& test) { return test.param.file; });

}  // namespace
}  // namespace berth
