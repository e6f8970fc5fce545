// Gradients against finite differences of FCL's distances; what a motion costs, against points of
// the meshes. BERTH_CONTROL_TWIN=full in the environment makes it 10^5 pairs and 10^6 steps.
#include "berth/control/distance_rows.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "sim/mesh_distance.hpp"
#include "tests/control/cases.hpp"
#include "tests/control/rows_robot.hpp"
#include "tests/support/allocation_count.hpp"
#include "tests/support/data_folder.hpp"
#include "tests/support/error_message.hpp"

namespace berth {
namespace {

constexpr double kStep = 1e-5;

/// Two links' true distance as one joint moves.
class TrueDistance {
 public:
  explicit TrueDistance(const RobotModel& model)
      : model_(model), trees_(sim::build_link_trees(model)) {}

  sim::SurfacePair at(std::size_t a, std::size_t b, std::vector<double> positions,
                      std::size_t joint, double step, double less_than_m) {
    positions[joint] += step;
    forward_kinematics(model_, positions, pose_);
    return sim::closest_points(trees_[a], pose_.X_BL[a], trees_[b], pose_.X_BL[b], less_than_m);
  }

 private:
  const RobotModel& model_;
  std::vector<sim::MeshTree> trees_;
  RobotPose pose_;
};

struct Compared {
  int pairs = 0;
  int stayed = 0;
  double worst = 0;
};

/// One link's gradient, of two joints, where the pair found is FCL's and stays the nearest.
void compare(const RowsRobot& robot, const std::vector<double>& positions, std::size_t i,
             const DistanceRows& rows, TrueDistance& truth, sim::Random& random, Compared& out) {
  const KnownPair& pair = robot.result.links[i].known;
  constexpr double kLeast_m = 0.02, kNear_m = 1e-3, kSamePoint = 1e-4, kSmooth = 5e-4;
  if (!pair.is_known() || pair.distance_m < kLeast_m) return;
  const std::size_t link = robot.model().evaluated_links[i];
  const auto other = static_cast<std::size_t>(pair.link);
  const sim::SurfacePair here = truth.at(link, other, positions, 0, 0, pair.distance_m + kNear_m);
  const double off_m = std::max((here.a_m - pair.robot_point_B_m.cast<double>()).norm(),
                                (here.b_m - pair.obstacle_point_B_m.cast<double>()).norm());
  ++out.pairs;
  const double near_m = here.distance_m + kNear_m;
  if (off_m > kSamePoint * here.distance_m) return;
  for (int k = 0; k < 2; ++k) {
    const auto j =
        static_cast<std::size_t>(random.whole(0, static_cast<int>(positions.size()) - 1));
    const double before_m = truth.at(link, other, positions, j, -kStep, near_m).distance_m;
    const double after_m = truth.at(link, other, positions, j, kStep, near_m).distance_m;
    if (std::abs(before_m + after_m - 2 * here.distance_m) > kSmooth * kStep) return;
    const double gradient =
        rows.gradient(RowKind::known)(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j));
    const double difference = (after_m - before_m) / (2 * kStep);
    out.worst = std::max(out.worst, std::abs(gradient - difference));
  }
  ++out.stayed;
}

void compare_with_fcl(const RobotSettings& settings, int poses) {
  RowsRobot robot(settings);
  DistanceRows rows(robot.robot);
  TrueDistance truth(robot.model());
  sim::Random random(5);
  Compared out;
  for (int k = 0; k < poses; ++k) {
    const std::vector<double> positions = robot.draw_positions(random);
    robot.ask(positions, 2e-5);
    rows.update(robot.result);
    for (std::size_t i = 0; i < robot.result.links.size(); ++i) {
      compare(robot, positions, i, rows, truth, random, out);
    }
  }
  EXPECT_GT(out.stayed, poses);
  EXPECT_GT(3 * out.stayed, out.pairs);
  EXPECT_LT(out.worst, 1e-3);
}

TEST(DistanceRows, GradientsOfKnownAreTheDifferencesOfFcl) {
  compare_with_fcl(bundled_arm(), cases(10'000));
}
TEST(DistanceRows, BothArmsMoveAPair) { compare_with_fcl(two_arms_in_two(), cases(10'000)); }
TEST(DistanceRows, GradientsOfARealRobotAndItsGripper) {
  const auto urdf = data_folder() / "robots/kinova_gen3_2f85/gen3_robotiq_2f_85.urdf";
  if (!std::filesystem::exists(urdf)) GTEST_SKIP() << "no " << urdf << "; set BERTH_DATA";
  compare_with_fcl({.urdf = urdf}, cases(10'000));
}

TEST(DistanceRows, OfWhatTheCamerasSeeTheLinkAloneMoves) {
  RowsRobot robot(bundled_arm());
  DistanceRows rows(robot.robot);
  sim::Random random(6);
  RobotPose moved;
  for (int k = 0; k < cases(100'000); ++k) {
    std::vector<double> positions = robot.draw_positions(random);
    forward_kinematics(robot.model(), positions, robot.result.pose);
    const auto i = static_cast<std::size_t>(random.whole(1, 7));
    const Eigen::Vector3d p_L_m(random(-0.1, 0.1), random(-0.1, 0.1), random(-0.1, 0.1));
    const Eigen::Vector3d obstacle_B_m(random(-1, 1), random(-1, 1), random(1.5, 2));
    const RowKind kind = k % 2 == 0 ? RowKind::nearest : RowKind::occupied;
    LinkResult& link = robot.result.links[i];
    put(robot, i, p_L_m, obstacle_B_m, kind == RowKind::nearest ? link : link.occupied);
    rows.update(robot.result);
    for (std::size_t j = 0; j < positions.size(); ++j) {
      const auto distance_m = [&](double step) {
        std::vector<double> q = positions;
        q[j] += step;
        forward_kinematics(robot.model(), q, moved);
        return (moved.X_BL[robot.model().evaluated_links[i]] * p_L_m - obstacle_B_m).norm();
      };
      ASSERT_NEAR(rows.gradient(kind)(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)),
                  (distance_m(kStep) - distance_m(-kStep)) / (2 * kStep), 1e-5);
    }
    static_cast<SpacePair&>(link) = link.occupied = SpacePair();
  }
}

TEST(DistanceRows, EachCandidateHasARow) {
  RowsRobot robot(bundled_arm(), 3);
  DistanceRows rows(robot.robot), own(robot.robot);
  forward_kinematics(robot.model(), std::vector<double>(7, 0.3), robot.result.pose);
  LinkResult& link = robot.result.links[5];
  SpacePair beside;
  put(robot, 5, {0.05, 0, 0}, {0.5, 0.5, 1}, link);
  put(robot, 5, {-0.05, 0, 0}, {-0.5, 0.2, 1}, beside);
  link.candidates.emplace_back() = beside;
  rows.update(robot.result);
  robot.result.links[5].candidates.clear();
  static_cast<SpacePair&>(robot.result.links[5]) = beside;
  own.update(robot.result);
  EXPECT_EQ(rows.gradient(RowKind::nearest, 1).row(5), own.gradient(RowKind::nearest).row(5));
  EXPECT_EQ(rows.normal_B(RowKind::nearest, 1).row(5), own.normal_B(RowKind::nearest).row(5));
  EXPECT_NE(rows.gradient(RowKind::nearest).row(5), own.gradient(RowKind::nearest).row(5));
  EXPECT_TRUE(rows.gradient(RowKind::nearest, 2).array().isNaN().all()) << "there is none";
  const auto message = [&](RowKind kind, int candidate) {
    return error_message<std::out_of_range>([&] { rows.gradient(kind, candidate); });
  };
  EXPECT_EQ(message(RowKind::nearest, 3), "candidate: 3; expected 0 to 2 for nearest");
  EXPECT_EQ(message(RowKind::known, 1), "candidate: 1; expected 0 to 0 for known");
  EXPECT_EQ(message(RowKind::nearest, -1), "candidate: -1; expected 0 to 2 for nearest");
}

TEST(DistanceRows, WithoutAPairThereIsNoneAndInContactItIs0) {
  RowsRobot robot(bundled_arm());
  DistanceRows rows(robot.robot);
  forward_kinematics(robot.model(), std::vector<double>(7, 0.3), robot.result.pose);
  rows.update(robot.result);
  EXPECT_TRUE(rows.gradient(RowKind::known).array().isNaN().all());
  put(robot, 7, {0, 0, 0.1}, {1, 0, 1}, robot.result.links[7]);
  rows.update(robot.result);
  EXPECT_TRUE(rows.gradient(RowKind::nearest).row(7).array().isFinite().all());
  EXPECT_TRUE(rows.gradient(RowKind::nearest).row(6).array().isNaN().all());
  const SpacePair& pair = robot.result.links[7];
  const Eigen::Vector3d normal_B =
      (pair.robot_point_B_m - pair.obstacle_point_B_m).normalized().cast<double>();
  EXPECT_TRUE(rows.normal_B(RowKind::nearest).row(7).isApprox(normal_B.transpose(), 1e-6));
  EXPECT_TRUE(rows.normal_B(RowKind::nearest).row(6).array().isNaN().all());
  robot.result.links[7].distance_m = 0;
  rows.update(robot.result);
  EXPECT_TRUE((rows.gradient(RowKind::nearest).row(7).array() == 0).all());
  EXPECT_TRUE(rows.normal_B(RowKind::nearest).row(7).isApprox(normal_B.transpose(), 1e-6));
  withhold(robot.result);
  rows.update(robot.result);
  EXPECT_TRUE(rows.gradient(RowKind::nearest).array().isNaN().all());
  EXPECT_TRUE(rows.normal_B(RowKind::nearest).array().isNaN().all());
}

TEST(DistanceRows, RefusesTheResultOfAnotherRobot) {
  DistanceRows rows(RowsRobot(bundled_arm()).robot);
  const RowsRobot two(two_arms_in_two());
  EXPECT_EQ(error_message<std::invalid_argument>([&] { rows.update(two.result); }),
            "result: 16 links; expected 8, those of robot \"berth_arm\"");
}

TEST(DistanceRows, AllocatesNothing) {
  RowsRobot robot(two_arms_in_two());
  DistanceRows rows(robot.robot);
  robot.ask(std::vector<double>(14, 0.3));
  const std::size_t before = allocation_count();
  rows.update(robot.result);
  EXPECT_EQ(allocation_count(), before);
}

/// A gantry with an arm on it, whose slides lie between turning joints.
RobotSettings gantry() {
  const auto link = [](const std::string& name) {
    return "<link name=\"" + name +
           "\"><visual><origin xyz=\"0.05 0 0.1\"/><geometry>"
           "<box size=\"0.06 0.1 0.2\"/></geometry></visual></link>";
  };
  std::string urdf = "<robot name=\"gantry\">" + link("l0");
  const std::array<const char*, 5> types = {"revolute", "prismatic", "revolute", "prismatic",
                                            "revolute"};
  for (std::size_t i = 0; i < types.size(); ++i) {
    const std::string parent = std::to_string(i), child = std::to_string(i + 1);
    urdf += link("l" + child) + "<joint name=\"j" + child + "\" type=\"" + types[i] +
            "\"><parent link=\"l" + parent + "\"/><child link=\"l" + child +
            "\"/><origin xyz=\"0.1 0 0.3\" rpy=\"0.4 0.2 0\"/><axis xyz=\"0 " +
            (i == 2 ? "1 0" : "0 1") +
            "\"/><limit lower=\"-1\" upper=\"1\" effort=\"1\" "
            "velocity=\"1\"/></joint>";
  }
  return {.urdf = "gantry.urdf", .urdf_text = urdf + "</robot>"};
}

Eigen::Vector3d drawn_vertex(const RobotModel& model, std::size_t link, sim::Random& random) {
  const auto& vertices_m = model.links[link].mesh_L.vertices_m;
  const int place = random.whole(0, static_cast<int>(vertices_m.size()) - 1);
  return vertices_m[static_cast<std::size_t>(place)].cast<double>();
}

/// Points of two links move no farther against one another, nor against the world, than the rows
/// say. Returns the greatest share of it that one moved.
double check_reach(const RobotSettings& settings, int steps) {
  RowsRobot robot(settings);
  DistanceRows rows(robot.robot);
  const KnownModel& known = robot.robot->known();
  sim::Random random(7);
  RobotPose moved;
  double greatest_share = 0;
  for (int k = 0; k < steps; ++k) {
    std::vector<double> positions = robot.draw_positions(random);
    forward_kinematics(robot.model(), positions, robot.result.pose);
    rows.update(robot.result);
    const double size = std::pow(10.0, random(-3, 0.5));
    Eigen::VectorXd step(std::ssize(positions));
    for (std::size_t j = 0; j < positions.size(); ++j) {
      step[static_cast<Eigen::Index>(j)] = random.chance(0.4) ? random(-size, size) : 0;
      positions[j] += step[static_cast<Eigen::Index>(j)];
    }
    forward_kinematics(robot.model(), positions, moved);
    const auto& [a, b] = known.pairs[static_cast<std::size_t>(
        random.whole(0, static_cast<int>(known.pairs.size()) - 1))];
    const std::size_t link = known.bodies[a].link, other = known.bodies[b].link;
    const Eigen::Vector3d p_m = drawn_vertex(robot.model(), link, random);
    const Eigen::Vector3d o_m = drawn_vertex(robot.model(), other, random);
    const auto apart_m = [&](const RobotPose& pose) {
      return (pose.X_BL[link] * p_m - pose.X_BL[other] * o_m).norm();
    };
    const double went_m = (moved.X_BL[link] * p_m - robot.result.pose.X_BL[link] * p_m).norm();
    const double nearer_m = std::abs(apart_m(moved) - apart_m(robot.result.pose));
    const auto most_m = [&](RowKind kind) {
      return rows.reach_m(kind).row(static_cast<Eigen::Index>(a)).dot(step.cwiseAbs()) + 1e-9;
    };
    EXPECT_LE(went_m, most_m(RowKind::nearest));
    EXPECT_LE(nearer_m, most_m(RowKind::known));
    if (testing::Test::HasFailure()) return 0;
    greatest_share = std::max(greatest_share, went_m / most_m(RowKind::nearest));
  }
  return greatest_share;
}

TEST(Reach, NoStepCostsMore) {
  EXPECT_GT(check_reach(bundled_arm(), cases(300'000)), 0.8);
  EXPECT_GT(check_reach(two_arms_in_two(), cases(300'000)), 0.8);
  EXPECT_GT(check_reach(gantry(), cases(300'000)), 0.8);
}

TEST(Reach, NoStepOfAGripperCostsMore) {
  const auto urdf = data_folder() / "robots/kinova_gen3_2f85/gen3_robotiq_2f_85.urdf";
  if (!std::filesystem::exists(urdf)) GTEST_SKIP() << "no " << urdf << "; set BERTH_DATA";
  EXPECT_GT(check_reach({.urdf = urdf}, cases(100'000)), 0.8);
}

TEST(Reach, NothingKnownIsNearerAfterAStep) {
  RowsRobot robot(two_arms_in_two());
  DistanceRows rows(robot.robot);
  sim::Random random(8);
  int fell = 0;
  for (int k = 0; k < cases(30'000); ++k) {
    std::vector<double> positions = robot.draw_positions(random);
    robot.ask(positions);
    rows.update(robot.result);
    const std::vector<KnownPair> before = robot.pairs;
    const double size = std::pow(10.0, random(-3, -0.5));
    Eigen::VectorXd most_m = Eigen::VectorXd::Zero(std::ssize(before));
    for (std::size_t j = 0; j < positions.size(); ++j) {
      const double step = random(-size, size);
      positions[j] += step;
      most_m += std::abs(step) * rows.reach_m(RowKind::known).col(static_cast<Eigen::Index>(j));
    }
    robot.ask(positions);
    for (std::size_t i = 0; i < before.size(); ++i) {
      if (!robot.pairs[i].is_known() || std::isnan(before[i].lower_bound_m)) continue;
      const double bound_m = before[i].lower_bound_m - most_m[static_cast<Eigen::Index>(i)];
      ASSERT_GE(robot.pairs[i].distance_m, bound_m - 1e-6);
      fell += robot.pairs[i].distance_m < before[i].lower_bound_m;
    }
  }
  EXPECT_GT(fell, cases(30'000));
}

TEST(Reach, OfOneJointIsItsFarthestPoint) {
  RowsRobot robot(gantry());
  DistanceRows rows(robot.robot);
  forward_kinematics(robot.model(), std::vector<double>(5, 0.0), robot.result.pose);
  rows.update(robot.result);
  const double corner_m = Eigen::Vector3d(0.08, 0.05, 0.2).norm();
  const double between_m = Eigen::Vector2d(0.1, 0.3).norm();
  const auto row = rows.reach_m(RowKind::nearest).row(5);
  EXPECT_NEAR(row[4], corner_m, 1e-6);
  EXPECT_EQ(row[3], 1);
  EXPECT_NEAR(row[2], corner_m + 2 * between_m, 1e-6);
  // It slides between: farther out, farther away.
  forward_kinematics(robot.model(), {0, 0, 0, 0.5, 0}, robot.result.pose);
  rows.update(robot.result);
  EXPECT_GT(rows.reach_m(RowKind::nearest)(5, 2), corner_m + 2 * between_m + 0.3);
}

}  // namespace
}  // namespace berth
