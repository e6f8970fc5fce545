#include "berth/robot/kinematics.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <numbers>
#include <random>

#include "tests/robot/error_text.hpp"
#include "tests/robot/robot_text.hpp"

namespace berth {
namespace {

constexpr double kQuarter = std::numbers::pi / 2;

/// base -(turns around z at x = 1)-> arm -(slides along its own y, 2 above)-> slide -(fixed)-> tool
RobotModel arm_model() {
  const TemporaryFolder folder;
  return load_text(folder,
                   robot_xml(box_link_xml("base") + box_link_xml("arm") + box_link_xml("slide") +
                             box_link_xml("tool") +
                             joint_xml("turn", "revolute", "base", "arm",
                                       R"(<origin xyz="1 0 0"/><axis xyz="0 0 2"/>)") +
                             joint_xml("slide", "prismatic", "arm", "slide",
                                       R"(<origin xyz="0 0 2"/><axis xyz="0 5 0"/>)") +
                             joint_xml("hold", "fixed", "slide", "tool",
                                       R"(<origin xyz="1 0 0" rpy="3.141592653589793 0 0"/>)")));
}

Pose pose_of(const RobotModel& model, const std::vector<double>& positions, const char* link) {
  RobotPose pose;
  forward_kinematics(model, positions, pose);
  return pose.X_BL.at(model.find_link(link).value());
}

TEST(Kinematics, PosesByHand) {
  const RobotModel model = arm_model();
  EXPECT_TRUE(pose_of(model, {0.3, 0.4}, "base").isApprox(Pose::Identity(), 1e-15));
  const Pose zero = pose_of(model, {0, 0}, "tool");
  EXPECT_TRUE(zero.translation().isApprox(Eigen::Vector3d(2, 0, 2), 1e-12));

  // A quarter turn takes the arm's x to y and its y to -x; the slide goes 0.5 m, whatever the
  // length of the axis in the file.
  const Pose turned = pose_of(model, {kQuarter, 0.5}, "tool");
  EXPECT_TRUE(turned.translation().isApprox(Eigen::Vector3d(1 - 0.5, 1, 2), 1e-12));
  EXPECT_TRUE(
      (turned.linear() * Eigen::Vector3d::UnitX()).isApprox(Eigen::Vector3d::UnitY(), 1e-12));
  EXPECT_TRUE(
      (turned.linear() * Eigen::Vector3d::UnitZ()).isApprox(-Eigen::Vector3d::UnitZ(), 1e-12));
}

TEST(Kinematics, MimicJointMovesByMultiplierAndOffset) {
  const TemporaryFolder folder;
  const RobotModel model = load_text(
      folder, robot_xml(box_link_xml("base") + box_link_xml("left") + box_link_xml("right") +
                        joint_xml("left", "prismatic", "base", "left") +
                        joint_xml("right", "prismatic", "base", "right",
                                  R"(<mimic joint="left" multiplier="-2" offset="0.1"/>)")));
  EXPECT_NEAR(pose_of(model, {0.3}, "left").translation().x(), 0.3, 1e-15);
  EXPECT_NEAR(pose_of(model, {0.3}, "right").translation().x(), -2 * 0.3 + 0.1, 1e-15);
}

/// Rotation by Rodrigues' formula with the axis as written.
Eigen::Matrix4d rotation(const Eigen::Vector3d& axis, double angle) {
  const Eigen::Vector3d n = axis / axis.norm();
  Eigen::Matrix3d cross;
  cross << 0, -n.z(), n.y(), n.z(), 0, -n.x(), -n.y(), n.x(), 0;
  Eigen::Matrix4d m = Eigen::Matrix4d::Identity();
  m.topLeftCorner<3, 3>() += std::sin(angle) * cross + (1 - std::cos(angle)) * cross * cross;
  return m;
}

Eigen::Matrix4d translation(const Eigen::Vector3d& p) {
  Eigen::Matrix4d m = Eigen::Matrix4d::Identity();
  m.topRightCorner<3, 1>() = p;
  return m;
}

std::string text(const Eigen::Vector3d& v) {
  return std::to_string(v.x()) + " " + std::to_string(v.y()) + " " + std::to_string(v.z());
}

TEST(Kinematics, RandomChainsAreTheProductOfTheirMatrices) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> any(-2, 2);
  // What std::to_string writes, so that the URDF and the product hold the same numbers.
  const auto rounded = [&] { return std::round(any(random) * 1e6) / 1e6; };
  const auto vector = [&] { return Eigen::Vector3d(rounded(), rounded(), rounded()); };
  const char* types[] = {"fixed", "revolute", "continuous", "prismatic"};
  for (int trial = 0; trial < 20; ++trial) {
    std::string xml = box_link_xml("link_0");
    Eigen::Matrix4d expected = Eigen::Matrix4d::Identity();
    std::vector<double> positions;
    for (int i = 1; i <= 8; ++i) {
      const int type = static_cast<int>(random() % 4);
      const Eigen::Vector3d xyz = vector();
      const Eigen::Vector3d rpy = vector();
      const Eigen::Vector3d axis = vector();
      const double q = type == 0 ? 0 : any(random);
      if (type != 0) positions.push_back(q);
      const std::string name = "link_" + std::to_string(i);
      xml += box_link_xml(name) + joint_xml("joint_" + std::to_string(i), types[type],
                                            "link_" + std::to_string(i - 1), name,
                                            "<origin xyz=\"" + text(xyz) + "\" rpy=\"" + text(rpy) +
                                                "\"/><axis xyz=\"" + text(axis) + "\"/>");
      expected = expected * translation(xyz) * rotation(Eigen::Vector3d::UnitZ(), rpy.z()) *
                 rotation(Eigen::Vector3d::UnitY(), rpy.y()) *
                 rotation(Eigen::Vector3d::UnitX(), rpy.x()) *
                 (type == 3 ? translation(q * axis / axis.norm()) : rotation(axis, q));
    }
    const TemporaryFolder folder;
    const Pose actual = pose_of(load_text(folder, robot_xml(xml)), positions, "link_8");
    EXPECT_LE((actual.matrix() - expected).cwiseAbs().maxCoeff(), 1e-9) << "trial " << trial;
  }
}

TEST(Kinematics, PoseOfAnotherRobotIsReplaced) {
  RobotPose pose;
  pose.X_BL.resize(50);
  forward_kinematics(arm_model(), {0, 0}, pose);
  EXPECT_EQ(pose.X_BL.size(), 4U);
}

/// The twist of each link, from two poses a short time before and after.
std::vector<LinkTwist> differences(const RobotModel& model, const std::vector<double>& positions,
                                   const std::vector<double>& velocities) {
  constexpr double kStep_s = 1e-6;
  RobotPose before, after;
  std::vector<double> q = positions;
  for (std::size_t i = 0; i < q.size(); ++i) q[i] = positions[i] - kStep_s * velocities[i];
  forward_kinematics(model, q, before);
  for (std::size_t i = 0; i < q.size(); ++i) q[i] = positions[i] + kStep_s * velocities[i];
  forward_kinematics(model, q, after);
  std::vector<LinkTwist> twists;
  for (std::size_t i = 0; i < model.links.size(); ++i) {
    const Eigen::Matrix3d turn = after.X_BL[i].linear() * before.X_BL[i].linear().transpose();
    const Eigen::AngleAxisd angle(turn);
    twists.push_back({(after.X_BL[i].translation() - before.X_BL[i].translation()) / (2 * kStep_s),
                      angle.angle() / (2 * kStep_s) * angle.axis()});
  }
  return twists;
}

TEST(LinkTwists, AreTheDerivativesOfThePoses) {
  const TemporaryFolder folder;
  const RobotModel model = load_text(
      folder,
      robot_xml(box_link_xml("base") + box_link_xml("arm") + box_link_xml("slide") +
                box_link_xml("tool") + box_link_xml("finger") +
                joint_xml("turn", "revolute", "base", "arm",
                          R"(<origin xyz="1 0 0" rpy="0.3 0.2 0.1"/><axis xyz="0.2 1 2"/>)") +
                joint_xml("slide", "prismatic", "arm", "slide",
                          R"(<origin xyz="0 0.5 2" rpy="1 0 0"/><axis xyz="0 5 1"/>)") +
                joint_xml("roll", "continuous", "slide", "tool",
                          R"(<origin xyz="1 0 0.3"/><axis xyz="1 0 0"/>)") +
                joint_xml("finger", "revolute", "tool", "finger",
                          R"(<origin xyz="0.1 0 0"/><axis xyz="0 0 1"/>)"
                          R"(<mimic joint="turn" multiplier="-2" offset="0.1"/>)")));
  ASSERT_EQ(model.joints.size(), 3U);
  std::mt19937 random(4);
  std::uniform_real_distribution<double> number(-2, 2);
  for (int trial = 0; trial < 50; ++trial) {
    const std::vector<double> positions{number(random), number(random), number(random)};
    const std::vector<double> velocities{number(random), number(random), number(random)};
    RobotPose pose;
    forward_kinematics(model, positions, pose);
    std::vector<LinkTwist> twists;
    link_twists(model, pose, velocities, twists);
    const std::vector<LinkTwist> expected = differences(model, positions, velocities);
    ASSERT_EQ(twists.size(), expected.size());
    for (std::size_t i = 0; i < twists.size(); ++i) {
      EXPECT_LE((twists[i].linear_B_m_s - expected[i].linear_B_m_s).norm(), 1e-6) << i;
      EXPECT_LE((twists[i].angular_B_rad_s - expected[i].angular_B_rad_s).norm(), 1e-6) << i;
    }
  }
}

TEST(PointJacobian, TimesVelocitiesIsTheVelocityOfThePoint) {
  const RobotModel model = arm_model();
  const std::vector<double> positions{0.7, 0.3}, velocities{1.1, -0.4};
  RobotPose pose;
  forward_kinematics(model, positions, pose);
  std::vector<LinkTwist> twists;
  link_twists(model, pose, velocities, twists);
  for (std::size_t i = 0; i < model.links.size(); ++i) {
    const Eigen::Vector3d arm_B(0.3, -0.2, 0.5);
    Eigen::Matrix3Xd jacobian;
    point_jacobian(model, pose, i, pose.X_BL[i].translation() + arm_B, jacobian);
    ASSERT_EQ(jacobian.cols(), 2);
    const Eigen::Vector3d expected =
        twists[i].linear_B_m_s + twists[i].angular_B_rad_s.cross(arm_B);
    EXPECT_LE((jacobian * Eigen::Vector2d(1.1, -0.4) - expected).norm(), 1e-12) << i;
  }
}

TEST(LinkTwists, NeedAVelocityForEachJoint) {
  const RobotModel model = arm_model();
  RobotPose pose;
  forward_kinematics(model, {0, 0}, pose);
  std::vector<LinkTwist> twists;
  expect_error<std::invalid_argument>(
      [&] { link_twists(model, pose, std::vector<double>{1}, twists); },
      {"joint velocities", "\"test\"", "1", "expected 2"});
}

TEST(Kinematics, WrongNumberOfPositionsThrows) {
  const RobotModel model = arm_model();
  RobotPose pose;
  for (const std::vector<double>& positions : {std::vector<double>{}, {1}, {1, 2, 3}}) {
    expect_error<std::invalid_argument>(
        [&] { forward_kinematics(model, positions, pose); },
        {std::to_string(positions.size()) + " positions", "expected 2"});
  }
}

TEST(Kinematics, PositionThatIsNotFiniteThrows) {
  const RobotModel model = arm_model();
  RobotPose pose;
  for (const double bad :
       {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
    expect_error<std::invalid_argument>(
        [&] {
          forward_kinematics(model, {0, bad}, pose);
        },
        {"\"slide\"", "expected a finite number"});
  }
}

}  // namespace
}  // namespace berth
