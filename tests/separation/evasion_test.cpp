// What gives way gives way, and what is held back does not come nearer.
#include "berth/separation/evasion.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/allocation_count.hpp"
#include "tests/support/error_message.hpp"

namespace berth {
namespace {

std::shared_ptr<const Robot> bundled_robot() {
  RobotSettings settings;
  settings.urdf = BERTH_SOURCE_DIR "/data/bundled/arm/arm.urdf";
  settings.package_paths["berth_arm"] = BERTH_SOURCE_DIR "/data/bundled/arm";
  settings.environment_links = {"table"};
  return std::make_shared<const Robot>(load_robot(settings));
}

const std::vector<double> kPosition{0.1, 0.5, 0.2, -1.3, 0.1, 1.0, 0.3};

class Evading : public ::testing::Test {
 protected:
  Evading() : robot_(bundled_robot()), evader_(robot_, "arm_link_7", settings_) {
    forward_kinematics(robot_->model(), kPosition, pose_);
    result_.status = ResultStatus::ok;
    result_.pose = pose_;
    for (int id = 1; id <= robot_->model().link_count(); ++id) {
      LinkResult& link = result_.links.emplace_back();
      link.id = static_cast<LinkId>(id);
      link.status = LinkStatus::none_in_range;
    }
  }

  /// Something at this distance of the link's origin, in this direction.
  void put(LinkId id, const Eigen::Vector3d& direction_B, double distance_m) {
    LinkResult& link = result_.links[id - 1];
    link.status = LinkStatus::ok;
    link.distance_m = static_cast<float>(distance_m);
    const Eigen::Vector3d p_B = pose_.X_BL[robot_->model().evaluated_links[id - 1]].translation();
    link.robot_point_B_m = p_B.cast<float>();
    link.obstacle_point_B_m = (p_B + distance_m * direction_B.normalized()).cast<float>();
  }
  const Evasion& update() { return evader_.update(result_); }

  /// How fast the link's point goes towards its obstacle with these joint velocities.
  double approach_m_s(LinkId id, const std::vector<double>& velocity) {
    const LinkResult& link = result_.links[id - 1];
    Eigen::Matrix3Xd jacobian;
    point_jacobian(robot_->model(), pose_, robot_->model().evaluated_links[id - 1],
                   link.robot_point_B_m.cast<double>(), jacobian);
    const Eigen::Map<const Eigen::VectorXd> v(velocity.data(), std::ssize(velocity));
    return (link.obstacle_point_B_m - link.robot_point_B_m)
        .cast<double>()
        .normalized()
        .dot(jacobian * v);
  }

  EvasionSettings settings_;
  std::shared_ptr<const Robot> robot_;
  Evader evader_;
  RobotPose pose_;
  Result result_;
};

TEST_F(Evading, WhereNothingIsNearThePlanStands) {
  const Evasion& evasion = update();
  for (std::size_t j = 0; j < kPosition.size(); ++j) {
    EXPECT_EQ(evasion.velocity[j], 0);
    EXPECT_EQ(evasion.forward[j], 1);
    EXPECT_EQ(evasion.backward[j], 1);
  }
  put(8, {1, 0, 0}, 0.7);
  EXPECT_EQ(update().velocity[0], 0) << "out of reach";
}

TEST_F(Evading, TheEndEffectorGoesAwayFromWhatIsNear) {
  for (const Eigen::Vector3d& direction_B :
       {Eigen::Vector3d(1, 0, 0), Eigen::Vector3d(0, 1, 0), Eigen::Vector3d(-1, 1, 1)}) {
    put(8, direction_B, 0.1);
    EXPECT_LT(approach_m_s(8, update().velocity), -0.2);
  }
}

TEST_F(Evading, TheNearerTheFaster) {
  double before_m_s = 0;
  for (const double distance_m : {0.59, 0.4, 0.3, 0.2, 0.1, 0.01}) {
    put(8, {1, 0, 0}, distance_m);
    const double speed_m_s = -approach_m_s(8, update().velocity);
    EXPECT_GT(speed_m_s, before_m_s);
    before_m_s = speed_m_s;
  }
  EXPECT_LE(before_m_s, settings_.max_speed_m_s);
}

TEST_F(Evading, TheMeanDirectionCountsWhereItIsKnown) {
  put(8, {1, 0, 0}, 0.1);
  LinkResult& link = result_.links[7];
  link.mean_direction_B = {0, 0.9F, 0};
  link.mean_count = 100;
  const std::vector<double> velocity = update().velocity;
  put(8, {0, 1, 0}, 0.1);
  EXPECT_LT(approach_m_s(8, velocity), -0.2);
}

TEST_F(Evading, TheBodyHoldsBackWhatWouldBringItNearer) {
  put(5, {0, 1, 0}, 0.05);
  const Evasion& evasion = update();
  int held = 0;
  for (std::size_t j = 0; j < kPosition.size(); ++j) {
    std::vector<double> alone(kPosition.size(), 0);
    alone[j] = 1;
    const double nearer = approach_m_s(5, alone);
    if (std::abs(nearer) < 1e-6) continue;
    EXPECT_LT(nearer > 0 ? evasion.forward[j] : evasion.backward[j], 0.1);
    EXPECT_EQ(nearer > 0 ? evasion.backward[j] : evasion.forward[j], 1);
    ++held;
  }
  EXPECT_GE(held, 2);
  EXPECT_EQ(evasion.velocity[0], 0) << "the body does not move by itself";
}

TEST_F(Evading, TwoThatTouchHaveNoDirection) {
  put(8, {1, 0, 0}, 0);
  for (const double v : update().velocity) EXPECT_EQ(v, 0);
}

TEST_F(Evading, AllocatesNothing) {
  put(8, {1, 0, 0}, 0.1);
  put(5, {0, 1, 0}, 0.05);
  update();
  const std::size_t before = allocation_count();
  update();
  EXPECT_EQ(allocation_count(), before);
}

TEST_F(Evading, RefusesWhatIsWrong) {
  EXPECT_EQ(error_message<std::invalid_argument>([&] {
              Evader(robot_, "table", settings_);
            }).find("evasion: end effector \"table\"; expected one of arm_link_0, arm_link_1"),
            0U);
  settings_.reach_m = 0;
  EXPECT_EQ(error_message<std::invalid_argument>([&] { Evader(robot_, "arm_link_7", settings_); }),
            "evasion.reach_m: 0; expected a finite number above 0");
}

}  // namespace
}  // namespace berth
