// Broken URDFs and settings: each is refused with the file and the trouble, and in silence.
#include <gtest/gtest.h>

#include "tests/robot/error_text.hpp"
#include "tests/robot/mesh_writing.hpp"
#include "tests/robot/robot_text.hpp"

namespace berth {
namespace {

void expect_refused(const std::string& xml, std::initializer_list<std::string> parts,
                    const RobotSettings& settings = {}) {
  SCOPED_TRACE(xml);
  const TemporaryFolder folder;
  expect_error([&] { load_text(folder, xml, settings); }, parts);
  expect_error([&] { load_text(folder, xml, settings); },
               {(folder.path() / "robot.urdf").string()});
}

/// base and child with `joint_inside` in the joint between them.
std::string pair_xml(const std::string& type, const std::string& joint_inside = "") {
  return robot_xml(box_link_xml("base") + box_link_xml("child") +
                   joint_xml("elbow", type, "base", "child", joint_inside));
}

std::string shape_robot_xml(const std::string& geometry) {
  return robot_xml(link_xml("base", shape_xml(geometry)));
}

TEST(UrdfError, FileMissing) {
  expect_error([] { load_robot({.urdf = "/nowhere/robot.urdf"}); },
               {"/nowhere/robot.urdf: No such file", "expected a readable file"});
}

TEST(UrdfError, FileIsAFolder) {
  const TemporaryFolder folder;
  expect_error([&] { load_robot({.urdf = folder.path()}); },
               {folder.path().string() + ": is a folder; expected a file"});
}

TEST(UrdfError, FileEmptyOrNotXmlOrCut) {
  expect_refused("", {"empty"});
  expect_refused(" \n\t\n", {"empty"});
  expect_refused("joint: 3\n", {"not a valid URDF"});
  expect_refused("<robot name=\"a\"><link", {"not a valid URDF"});
  const std::string whole = pair_xml("fixed");
  expect_refused(whole.substr(0, whole.size() * 2 / 3), {"not a valid URDF"});
  expect_refused(std::string("<\0r\0", 4), {"zero byte; expected UTF-8, not UTF-16"});
}

TEST(UrdfError, LinksAndJointsThatAreNoTree) {
  expect_refused("<?xml version=\"1.0\"?><model name=\"a\"/>", {"not a valid URDF", "robot"});
  expect_refused(robot_xml(""), {"not a valid URDF", "link"});
  expect_refused(robot_xml(box_link_xml("one") + box_link_xml("two")),
                 {"robot.urdf:", "links one, two have no parent", "expected one root"});
  expect_refused(robot_xml(box_link_xml("a") + box_link_xml("b") +
                           joint_xml("ab", "fixed", "a", "b") + joint_xml("ba", "fixed", "b", "a")),
                 {"not a valid URDF", "root"});
  expect_refused(
      robot_xml(box_link_xml("base") + box_link_xml("left") + box_link_xml("right") +
                box_link_xml("bar") + joint_xml("l", "fixed", "base", "left") +
                joint_xml("r", "fixed", "base", "right") + joint_xml("lb", "fixed", "left", "bar") +
                joint_xml("rb", "fixed", "right", "bar")),
      {"\"bar\"", "\"lb\"", "\"rb\"", "loop"});
  expect_refused(robot_xml(box_link_xml("base") + box_link_xml("a") + box_link_xml("b") +
                           joint_xml("ab", "fixed", "a", "b") + joint_xml("ba", "fixed", "b", "a")),
                 {"not connected", "\"base\""});
  expect_refused(
      robot_xml(box_link_xml("base") + box_link_xml("a") + joint_xml("aa", "fixed", "a", "a")),
      {"\"a\""});
  expect_refused(
      robot_xml(box_link_xml("base") + box_link_xml("a") + joint_xml("j", "fixed", "nobody", "a")),
      {"not a valid URDF", "nobody"});
  expect_refused(robot_xml(box_link_xml("base") + joint_xml("j", "fixed", "base", "nobody")),
                 {"not a valid URDF", "nobody"});
  expect_refused(robot_xml(box_link_xml("base") + box_link_xml("base")),
                 {"not a valid URDF", "base"});
  expect_refused(
      robot_xml(box_link_xml("base") + box_link_xml("a") + box_link_xml("b") +
                joint_xml("j", "fixed", "base", "a") + joint_xml("j", "fixed", "base", "b")),
      {"not a valid URDF", "j"});
}

TEST(UrdfError, AJointThatTurnsHasLimits) {
  std::string xml = pair_xml("revolute");
  const std::size_t limit = xml.find("<limit");
  xml.erase(limit, xml.find('>', limit) + 1 - limit);
  expect_refused(xml, {"joint \"elbow\": is revolute and has no <limit>; expected <limit"});
}

TEST(UrdfError, MimicsOfNoJointThatMoves) {
  expect_refused(pair_xml("revolute", R"(<mimic joint="nobody"/>)"),
                 {"\"elbow\"", "\"nobody\"", "expected"});
  expect_refused(pair_xml("revolute", R"(<mimic joint="elbow"/>)"), {"\"elbow\"", "loop"});
  expect_refused(robot_xml(box_link_xml("base") + box_link_xml("a") + box_link_xml("b") +
                           joint_xml("one", "revolute", "base", "a", R"(<mimic joint="two"/>)") +
                           joint_xml("two", "revolute", "base", "b", R"(<mimic joint="one"/>)")),
                 {"\"one\"", "\"two\"", "loop"});
  expect_refused(robot_xml(box_link_xml("base") + box_link_xml("a") + box_link_xml("b") +
                           joint_xml("one", "fixed", "base", "a") +
                           joint_xml("two", "revolute", "base", "b", R"(<mimic joint="one"/>)")),
                 {"\"two\"", "\"one\"", "fixed"});
  expect_refused(robot_xml(box_link_xml("base") + box_link_xml("a") + box_link_xml("b") +
                           box_link_xml("c") + joint_xml("mover", "revolute", "base", "c") +
                           joint_xml("one", "fixed", "base", "a", R"(<mimic joint="mover"/>)") +
                           joint_xml("two", "revolute", "base", "b", R"(<mimic joint="one"/>)")),
                 {"\"two\"", "\"one\"", "fixed"});
}

TEST(UrdfError, JointWithoutASinglePosition) {
  for (const char* type : {"floating", "planar"})
    expect_refused(pair_xml(type),
                   {"\"elbow\"", std::string(type) + " joints have no single position",
                    "links \"base\" and \"child\"", "expected fixed, revolute"});
}

TEST(UrdfError, JointsOfUnknownTypeOrWithoutDirection) {
  expect_refused(pair_xml("screw"), {"not a valid URDF", "elbow"});
  expect_refused(pair_xml("revolute", R"(<axis xyz="0 0 0"/>)"), {"\"elbow\"", "axis", "0 0 0"});
}

TEST(UrdfError, NumbersThatAreNoneAndShapesWithoutExtent) {
  expect_refused(pair_xml("revolute", R"(<axis xyz="0 0 nan"/>)"), {"elbow"});
  expect_refused(pair_xml("revolute", R"(<axis xyz="0 0"/>)"), {"elbow"});
  expect_refused(pair_xml("fixed", R"(<origin xyz="0 0 inf"/>)"), {"elbow"});
  expect_refused(pair_xml("fixed", R"(<origin rpy="0 one 0"/>)"), {"elbow"});
  expect_refused(robot_xml(link_xml(
                     "base", shape_xml(R"(<box size="1 1 1"/>)", R"(<origin xyz="nan 0 0"/>)"))),
                 {"base"});
  expect_refused(shape_robot_xml(R"(<box size="1 0 1"/>)"),
                 {"\"base\"", "size=\"1 0 1\"; expected numbers above 0"});
  expect_refused(shape_robot_xml(R"(<box size="1 1 -2"/>)"), {"\"base\"", "size=\"1 1 -2\""});
  expect_refused(shape_robot_xml(R"(<cylinder radius="-1" length="1"/>)"),
                 {"\"base\"", "radius=\"-1\"; expected a number above 0"});
  expect_refused(shape_robot_xml(R"(<cylinder radius="1" length="0"/>)"),
                 {"\"base\"", "length=\"0\""});
  expect_refused(shape_robot_xml(R"(<sphere radius="0"/>)"), {"\"base\"", "radius=\"0\""});
  expect_refused(shape_robot_xml(R"(<box size="1 nan 1"/>)"), {"base"});
  expect_refused(shape_robot_xml(R"(<box size="inf 1 1"/>)"), {"base"});
  expect_refused(shape_robot_xml(R"(<box size="1 1"/>)"), {"base"});
  expect_refused(shape_robot_xml(R"(<sphere radius="big"/>)"), {"base"});
  expect_refused(shape_robot_xml(R"(<sphere radius="1e999"/>)"), {"base"});
  expect_refused(shape_robot_xml(R"(<cone radius="1" length="1"/>)"),
                 {"<cone> is a shape of unknown kind; expected mesh, box, cylinder"});
  expect_refused(robot_xml(link_xml("base", "<visual/>")),
                 {"<geometry> of a <visual> holds 0 shapes"});
  expect_refused(pair_xml("fixed", R"(<origin xyz="0,5 0 0"/>)"),
                 {":5: joint \"elbow\": <origin> has xyz=\"0,5 0 0\"; expected 3 finite numbers"});
  expect_refused(
      robot_xml(box_link_xml("base") + box_link_xml("a") + box_link_xml("b") +
                joint_xml("ja", "revolute", "base", "a") +
                joint_xml("jb", "revolute", "base", "b", R"(<mimic joint="ja" offset="a"/>)")),
      {"<mimic> has offset=\"a\"; expected 1 finite number"});
  expect_refused(shape_robot_xml(R"(<sphere radius="0,1"/>)"),
                 {":3: link \"base\": <sphere> has radius=\"0,1\"; expected 1 finite number"});
  expect_refused(shape_robot_xml(R"(<mesh filename="a.stl" scale="0.001"/>)"),
                 {"<mesh> has scale=\"0.001\"; expected 3 finite numbers"});
  expect_refused(
      shape_robot_xml(R"(<box size="500 1 1"/>)"),
      {"link \"base\": reaches 250.001 m from its origin; expected at most 100 m", "millimetres"});
  expect_refused(shape_robot_xml(R"(<box size="1e39 1 1"/>)"), {"link \"base\": reaches"});
  expect_refused(pair_xml("fixed", R"(<origin xyz="1e300 0 0"/>)"),
                 {"joint \"elbow\" is", "expected at most 100000 m"});
  expect_refused(
      robot_xml(box_link_xml("base") + link_xml("hall", shape_xml(R"(<box size="3e5 1 1"/>)")) +
                joint_xml("j", "fixed", "base", "hall")),
      {"link \"hall\": reaches 150000 m", "expected at most 100000 m"},
      {.environment_links = {"hall"}});
}

TEST(UrdfError, SeveralShapesInOneGeometryOfWhichOnlyOneWouldBeTaken) {
  for (const std::string kind : {"visual", "collision"}) {
    expect_refused(
        robot_xml(
            box_link_xml("base") +
            link_xml("two", shape_xml(R"(<box size="1 1 1"/><sphere radius="1"/>)", "", kind)) +
            joint_xml("j", "fixed", "base", "two")),
        {":4: link \"two\": <geometry> of a <" + kind + "> holds 2 shapes; expected one"});
  }
}

TEST(UrdfError, MeshOfTrianglesWithoutArea) {
  const TemporaryFolder folder;
  const Eigen::Vector3f p(1, 2, 3);
  folder.write("part.stl", binary_stl({{p, p, p}}));
  expect_error([&] { load_text(folder, shape_robot_xml(R"(<mesh filename="part.stl"/>)")); },
               {"robot.urdf", "\"base\""});
}

TEST(UrdfError, MeshOfAnUnknownScheme) {
  for (const char* name : {"ftp://a/part.stl", "http://a/part.stl"}) {
    expect_refused(shape_robot_xml(std::string("<mesh filename=\"") + name + "\"/>"),
                   {name, "expected package://NAME/PATH, file://PATH or a path"});
  }
}

TEST(UrdfError, ElementsNestedWithoutEnd) {
  std::string deep;
  for (int i = 0; i < 300; ++i) deep += "<a>\n";
  for (int i = 0; i < 300; ++i) deep += "</a>";
  expect_refused(robot_xml(deep + box_link_xml("base")),
                 {"not a valid URDF: <a> is nested 201 deep; expected less than that"});
}

TEST(UrdfError, MeshScaleOfZero) {
  const TemporaryFolder folder;
  folder.write("part.stl", binary_stl(two_triangles()));
  for (const char* scale : {"0 1 1", "1 1 0"}) {
    const std::string xml =
        shape_robot_xml(std::string(R"(<mesh filename="part.stl" scale=")") + scale + R"("/>)");
    expect_error([&] { load_text(folder, xml); },
                 {"robot.urdf", "\"base\"", "<mesh> has scale=\"", scale, "other than 0"});
  }
}

TEST(UrdfError, MeshMissing) {
  const TemporaryFolder folder;
  const std::string path = (folder.path() / "meshes/part.stl").string();
  expect_error([&] { load_text(folder, shape_robot_xml(R"(<mesh filename="meshes/part.stl"/>)")); },
               {"robot.urdf", "\"base\"", path + ": No such file"});
}

TEST(UrdfError, XacroThatWasNotExpanded) {
  for (const char* name : {"$(find arm_description)/part.stl", "${parts}/part.stl"}) {
    expect_refused(shape_robot_xml(std::string("<mesh filename=\"") + name + "\"/>"),
                   {"\"base\"", name, "is written for xacro; expected a URDF, such as xacro"});
  }
}

TEST(UrdfError, MeshUnreadable) {
  const TemporaryFolder folder;
  const auto file = folder.write("part.stl", binary_stl(two_triangles()).substr(0, 120));
  expect_error([&] { load_text(folder, shape_robot_xml(R"(<mesh filename="part.stl"/>)")); },
               {"robot.urdf", "\"base\"", file.string()});
}

TEST(UrdfError, MeshesWithoutNameOrPackage) {
  expect_refused(shape_robot_xml(R"(<mesh filename=""/>)"), {"base"});
  expect_refused(shape_robot_xml("<mesh/>"), {"base"});
  expect_refused(shape_robot_xml(R"(<mesh filename="package://gone/part.stl"/>)"),
                 {"\"base\"", "package://gone/part.stl", "\"gone\"", "package_paths [other]"},
                 {.package_paths = {{"other", "/somewhere"}}});
  expect_refused(shape_robot_xml(R"(<mesh filename="package://part.stl"/>)"),
                 {"\"base\"", "package://part.stl", "expected"});
  expect_refused(shape_robot_xml(R"(<mesh filename="package:///part.stl"/>)"),
                 {"\"base\"", "package:///part.stl", "expected package://NAME/PATH"});
}

TEST(UrdfError, SettingsThatNameNoSuchLink) {
  expect_refused(pair_xml("fixed"), {"environment_links", "\"table\"", "base, child"},
                 {.environment_links = {"table"}});
  expect_refused(pair_xml("fixed"), {"ignore_links", "\"table\"", "base, child"},
                 {.ignore_links = {"table"}});
  expect_refused(pair_xml("fixed"), {"guarded_links", "\"table\"", "base, child"},
                 {.guarded_links = {"table"}});
  expect_refused(pair_xml("continuous"), {"guarded_links: link \"child\" moves", "no joint moves"},
                 {.guarded_links = {"child"}});
  expect_refused(robot_xml(link_xml("base") + box_link_xml("child") +
                           joint_xml("joint", "fixed", "base", "child")),
                 {"guarded_links: link \"base\" has no shapes", "expected a link with shapes"},
                 {.guarded_links = {"base"}});
  expect_refused(robot_xml(link_xml("base")), {"no link with geometry"});
  expect_refused(pair_xml("fixed"), {"no link with geometry"},
                 {.environment_links = {"base"}, .ignore_links = {"child"}});
}

TEST(UrdfError, LoadingAfterAnErrorWorks) {
  const TemporaryFolder folder;
  expect_error([&] { load_text(folder, robot_xml("")); }, {"robot.urdf"});
  EXPECT_EQ(load_text(folder, pair_xml("fixed")).link_count(), 2);
}

}  // namespace
}  // namespace berth
