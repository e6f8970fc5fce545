// Real robots, read twice: by berth and by tests/support/urdf_reading.
#include <gtest/gtest.h>

#include <ostream>
#include <set>

#include "berth/robot/primitives.hpp"
#include "berth/robot/robot_model.hpp"
#include "tests/robot/error_text.hpp"
#include "tests/support/data_folder.hpp"
#include "tests/support/mesh_reading.hpp"
#include "tests/support/temporary_folder.hpp"
#include "tests/support/urdf_reading.hpp"

namespace berth {
namespace {

struct RobotFacts {
  const char* urdf;
  std::size_t links;
  std::size_t joints;  ///< whose position is to be given
  std::size_t mimic;
  std::size_t prismatic;
  std::size_t continuous;
};

/// What a test of it is called.
void PrintTo(const RobotFacts& robot, std::ostream* out) { *out << robot.urdf; }

const RobotFacts kRobots[] = {
    {"xarm7/xarm7.urdf", 10, 7, 0, 0, 0},
    {"xarm7/xarm7_with_gripper.urdf", 18, 8, 5, 0, 0},
    {"kuka_lbr_med7/lbr_med7.urdf", 10, 7, 0, 0, 0},
    {"franka_panda/panda.urdf", 12, 8, 1, 1, 0},
    {"kuka_iiwa_bullet/model.urdf", 8, 7, 0, 0, 0},
    {"kuka_lwr4_bullet/kuka.urdf", 8, 7, 0, 0, 0},
    {"kinova_gen3_2f85/gen3_robotiq_2f_85.urdf", 24, 8, 5, 0, 4},
    {"pr2/pr2.urdf", 82, 20, 10, 1, 4},
    {"widowx/widowx.urdf", 10, 7, 1, 1, 0},
    {"r2d2/r2d2.urdf", 16, 8, 0, 1, 5},
};

std::filesystem::path robots_folder() { return data_folder() / "robots"; }

class RealRobot : public testing::TestWithParam<RobotFacts> {
 protected:
  void SetUp() override {
    if (!std::filesystem::is_directory(robots_folder()))
      GTEST_SKIP() << "no real robots in " << robots_folder() << "; set BERTH_DATA";
  }
  std::filesystem::path urdf() const { return robots_folder() / GetParam().urdf; }
};

double area_m2(const TriangleMesh& mesh) {
  double area = 0;
  for (const auto& [a, b, c] : mesh.triangles) {
    const Eigen::Vector3d p = mesh.vertices_m[a].cast<double>();
    const Eigen::Vector3d q = mesh.vertices_m[b].cast<double>();
    const Eigen::Vector3d r = mesh.vertices_m[c].cast<double>();
    area += (q - p).cross(r - p).norm() / 2;
  }
  return area;
}

void expect_same_shapes(const Link& link, const LinkShapes& expected) {
  EXPECT_EQ(link.mesh_L.empty(), expected.box_L_m.isEmpty());
  if (link.mesh_L.empty() || expected.box_L_m.isEmpty()) return;
  const Eigen::AlignedBox3d box_L_m = link.mesh_L.bounding_box_m().cast<double>();
  const double excess_m = kMaxPrimitiveExcess * expected.curved_radius_m;
  for (int axis = 0; axis < 3; ++axis) {
    const double below_m = expected.box_L_m.min()[axis] - box_L_m.min()[axis];
    const double above_m = box_L_m.max()[axis] - expected.box_L_m.max()[axis];
    EXPECT_GE(below_m, -1e-5);
    EXPECT_LE(below_m, excess_m + 1e-5);
    EXPECT_GE(above_m, -1e-5);
    EXPECT_LE(above_m, excess_m + 1e-5);
  }
  // The box does not show a part that is missing inside; the area does.
  if (expected.curved_radius_m == 0) {
    EXPECT_NEAR(area_m2(link.mesh_L), expected.flat_area_m2, 1e-4 * expected.flat_area_m2);
  }
}

TEST_P(RealRobot, VisualShapesAgreeWithAnIndependentReading) {
  const RobotModel model = load_robot({.urdf = urdf()});
  const auto expected = read_link_shapes(urdf(), "visual");
  ASSERT_EQ(model.links.size(), expected.size());
  for (const Link& link : model.links) {
    SCOPED_TRACE(link.name);
    expect_same_shapes(link, expected.at(link.name));
  }
}

TEST_P(RealRobot, CollisionShapesAgreeWithAnIndependentReading) {
  const RobotModel model = load_robot({.urdf = urdf(), .geometry = GeometryKind::collision});
  const auto visual = read_link_shapes(urdf(), "visual");
  const auto collision = read_link_shapes(urdf(), "collision");
  ASSERT_EQ(model.links.size(), collision.size());
  for (const Link& link : model.links) {
    SCOPED_TRACE(link.name);
    const LinkShapes& own = collision.at(link.name);
    expect_same_shapes(link, own.box_L_m.isEmpty() ? visual.at(link.name) : own);
  }
}

TEST_P(RealRobot, HasTheJointsOfItsTable) {
  const RobotModel model = load_robot({.urdf = urdf()});
  const auto count = [&](JointType type) {
    return std::count_if(model.joints.begin(), model.joints.end(),
                         [&](const MovableJoint& joint) { return joint.type == type; });
  };
  EXPECT_EQ(model.links.size(), GetParam().links);
  EXPECT_EQ(model.joints.size(), GetParam().joints);
  EXPECT_EQ(model.mimic_joints.size(), GetParam().mimic);
  EXPECT_EQ(count(JointType::prismatic), GetParam().prismatic);
  EXPECT_EQ(count(JointType::continuous), GetParam().continuous);
}

INSTANTIATE_TEST_SUITE_P(Data, RealRobot, testing::ValuesIn(kRobots), [](const auto& robot) {
  std::string name = std::filesystem::path(robot.param.urdf).stem().string();
  if (name == "model") name = "iiwa";
  return name;
});

class RealRobots : public testing::Test {
 protected:
  void SetUp() override {
    if (!std::filesystem::is_directory(robots_folder()))
      GTEST_SKIP() << "no real robots in " << robots_folder() << "; set BERTH_DATA";
  }
};

TEST_F(RealRobots, EveryUrdfOfTheFolderIsInTheTable) {
  std::set<std::filesystem::path> known;
  for (const RobotFacts& robot : kRobots) known.insert(robots_folder() / robot.urdf);
  for (const auto& file : std::filesystem::recursive_directory_iterator(robots_folder())) {
    if (file.path().extension() == ".urdf") {
      EXPECT_TRUE(known.count(file.path())) << file.path();
    }
  }
}

TEST_F(RealRobots, PackageIsFoundBesideTheUrdfOrWhereTheSettingsSay) {
  const auto xarm = robots_folder() / "xarm7";
  const TemporaryFolder folder;
  const auto copy = folder.write("xarm7_alone.urdf", read_bytes(xarm / "xarm7.urdf"));
  expect_error([&] { load_robot({.urdf = copy}); }, {copy.string(), "\"xarm_description\""});
  const RobotModel model = load_robot(
      {.urdf = copy, .package_paths = {{"xarm_description", xarm / "xarm_description"}}});
  EXPECT_EQ(model.link_count(), load_robot({.urdf = xarm / "xarm7.urdf"}).link_count());
}

TEST_F(RealRobots, YUpAndZUpFilesOfOnePartHaveTheSameCoordinates) {
  // Why the up axis of a DAE is not applied: nobody who wrote these files meant it.
  const auto meshes =
      robots_folder() / "kinova_gen3_2f85/kortex_description/grippers/robotiq_2f_85/meshes";
  for (const char* part : {"inner_finger", "inner_knuckle", "outer_finger"}) {
    const std::string file = std::string("robotiq_arg2f_85_") + part + ".dae";
    ASSERT_NE(read_bytes(meshes / "visual" / file).find("Z_UP"), std::string::npos);
    ASSERT_NE(read_bytes(meshes / "collision" / file).find("Y_UP"), std::string::npos);
    const auto box_of = [&](const char* folder) {
      Eigen::AlignedBox3d box;
      for (const auto& triangle : read_triangles(meshes / folder / file))
        for (const Eigen::Vector3d& corner : triangle) box.extend(corner);
      return box;
    };
    const auto z_up = box_of("visual");
    const auto y_up = box_of("collision");
    EXPECT_LE((z_up.min() - y_up.min()).cwiseAbs().maxCoeff(), 0.05 * z_up.diagonal().norm());
    EXPECT_LE((z_up.max() - y_up.max()).cwiseAbs().maxCoeff(), 0.05 * z_up.diagonal().norm());
  }
}

}  // namespace
}  // namespace berth
