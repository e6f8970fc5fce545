#include "berth/fit/frame_drawer.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include "sim/random.hpp"

namespace berth {
namespace {

constexpr double kStamp_s = 3.0;
constexpr double kClockOffset_s = 0.25;

Pose some_pose(sim::Random& random) {
  Pose X(Eigen::AngleAxisd(random(0.2, 2), sim::draw_point(random, 1).normalized()));
  X.translation() = sim::draw_point(random, 0.5);
  return X;
}

/// A joint of each kind one after another, and one that follows the first.
RobotModel chain() {
  sim::Random random(7);
  RobotModel model;
  model.name = "chain";
  model.joints = {{"turn", JointType::revolute},
                  {"slide", JointType::prismatic},
                  {"wrist", JointType::continuous}};
  struct Part {
    JointType type;
    std::optional<std::size_t> position;
    double multiplier;
  };
  const Part parts[] = {{JointType::revolute, 0, 1},
                        {JointType::fixed, {}, 1},
                        {JointType::prismatic, 1, 1},
                        {JointType::revolute, 0, -0.5},
                        {JointType::continuous, 2, 1}};
  model.links.push_back({"base", {}, {}, LinkRole::ignored, kNoLink, {}});
  for (const Part& part : parts) {
    Link link;
    link.name = "link_" + std::to_string(model.links.size());
    link.parent = model.links.size() - 1;
    link.joint = {link.name,
                  part.type,
                  some_pose(random),
                  sim::draw_point(random, 1).normalized(),
                  part.position,
                  part.multiplier,
                  0.1};
    if (!part.position) link.joint.offset = 0;
    model.links.push_back(link);
  }
  return model;
}

class PosedRobotOf : public ::testing::TestWithParam<std::size_t> {
 protected:
  PosedRobotOf() {
    sim::Random random(3);
    camera_.parent = GetParam();
    camera_.X_PC = some_pose(random);
    camera_.clock_offset_s = kClockOffset_s;
    camera_.has_stamps = true;
    data_ = {&model_, nullptr, &joints_, {&camera_}};
    // As the camera's clock is believed to be; the frame's own joints are those of the trajectory.
    joints_.at(kStamp_s + kClockOffset_s, kOnlyBetweenSamples, frame_.joints);
    frame_.joints.stamp_s = kStamp_s;
    estimate_.cameras = {{.X_PC = camera_.X_PC, .clock_shift_s = 0.02}};
    estimate_.joint_shift = {0.03, -0.01, 0.02};
  }

  std::optional<PosedRobot> pose(const CalibrationEstimate& estimate,
                                 const PosedRobotRequest& request = {}) const {
    return pose_robot(data_, 0, frame_, estimate, request);
  }

  /// Where a point of a link is before the camera.
  Eigen::Vector3d point_C_m(const CalibrationEstimate& estimate, std::size_t link,
                            const Eigen::Vector3d& p_L_m) const {
    const auto posed = pose(estimate);
    return posed->X_BC.inverse() * posed->pose.X_BL[link] * p_L_m;
  }

  /// How it moves there when `shift` changes an estimate.
  template <class Shift>
  Eigen::Vector3d measured(std::size_t link, const Eigen::Vector3d& p_L_m,
                           const Shift& shift) const {
    constexpr double kStep = 1e-4;
    CalibrationEstimate before = estimate_;
    CalibrationEstimate after = estimate_;
    shift(-kStep, before);
    shift(kStep, after);
    return (point_C_m(after, link, p_L_m) - point_C_m(before, link, p_L_m)) / (2 * kStep);
  }

  RobotModel model_ = chain();
  /// At a constant speed each, so that speeds are exact.
  JointTrajectory joints_{
      model_, "test", {"turn", "slide", "wrist"}, {{0, {0.1, 0.2, 0.3}}, {10, {4.1, 1.2, -7.7}}}};
  CalibrationCamera camera_;
  CalibrationFrame frame_;
  CalibrationData data_;
  CalibrationEstimate estimate_;
};

constexpr double kClose = 2e-6;
const Eigen::Vector3d kPoint_L_m(0.2, -0.1, 0.3);

TEST_P(PosedRobotOf, JointsMoveItsPointsAsTheirTwistsSay) {
  const auto posed = pose(estimate_, {.per_joint = true});
  ASSERT_TRUE(posed);
  for (std::size_t link = 0; link < model_.links.size(); ++link) {
    const Eigen::Vector3d p_C_m = point_C_m(estimate_, link, kPoint_L_m);
    for (std::size_t j = 0; j < model_.joints.size(); ++j) {
      const Eigen::Vector3d expected = measured(
          link, kPoint_L_m, [j](double by, CalibrationEstimate& e) { e.joint_shift[j] += by; });
      EXPECT_LT((posed->per_joint[link][j].at(p_C_m) - expected).norm(), kClose)
          << "link " << link << ", joint " << j;
    }
  }
}

TEST_P(PosedRobotOf, TheClockMovesItsPointsAsTheirTwistsSay) {
  for (const double shift_s : {0.0, 0.02, -0.3}) {
    estimate_.cameras[0].clock_shift_s = shift_s;
    const auto posed = pose(estimate_, {.per_second = true});
    ASSERT_TRUE(posed);
    for (std::size_t link = 0; link < model_.links.size(); ++link) {
      const Eigen::Vector3d expected =
          measured(link, kPoint_L_m,
                   [](double by, CalibrationEstimate& e) { e.cameras[0].clock_shift_s += by; });
      const Eigen::Vector3d p_C_m = point_C_m(estimate_, link, kPoint_L_m);
      EXPECT_LT((posed->per_second[link].at(p_C_m) - expected).norm(), kClose)
          << "link " << link << ", shift " << shift_s;
    }
  }
}

TEST_P(PosedRobotOf, NothingIsKnownBeyondTheJointsSamples) {
  estimate_.cameras[0].clock_shift_s = 10 - kStamp_s - kClockOffset_s + 0.001;
  EXPECT_FALSE(pose(estimate_));
  estimate_.cameras[0].clock_shift_s = -kStamp_s - kClockOffset_s - 0.001;
  EXPECT_FALSE(pose(estimate_));
  estimate_.cameras[0].clock_shift_s = -kStamp_s - kClockOffset_s + 0.001;
  EXPECT_TRUE(pose(estimate_));
}

/// On the root, on a link in between that a joint moves, and on the last one.
INSTANTIATE_TEST_SUITE_P(OfACameraOn, PosedRobotOf, ::testing::Values(0U, 2U, 3U, 5U));

}  // namespace
}  // namespace berth
