// The certificate of a few poses holds for all between them: held against the mesh at many more.
#include "berth/separation/braking_path.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace berth {
namespace {

std::shared_ptr<const Robot> arm_on_table() {
  RobotSettings settings;
  settings.urdf = BERTH_SOURCE_DIR "/data/bundled/arm/arm.urdf";
  settings.package_paths["berth_arm"] = BERTH_SOURCE_DIR "/data/bundled/arm";
  settings.environment_links = {"table"};
  return std::make_shared<const Robot>(load_robot(settings));
}

/// A drawn way of the arm: straight on, or in a curve of many short pieces.
struct DrawnWay {
  std::vector<double> position;
  std::vector<double> velocity;
  std::vector<double> bend;
  std::vector<JointState> path;

  DrawnWay(std::size_t joints, bool is_curved, std::uint32_t seed) {
    std::mt19937 random(seed);
    const auto draw = [&](double most) {
      return most * (2 * static_cast<double>(random()) / 4294967296.0 - 1);
    };
    for (std::size_t j = 0; j < joints; ++j) {
      position.push_back(draw(1.2));
      velocity.push_back(draw(1.5));
      bend.push_back(is_curved ? draw(4) : 0);
    }
    if (!is_curved) return;
    for (int i = 0; i <= 40; ++i) path.push_back({0.02 * i, at(0.02 * i)});
  }

  /// Between the path's states it goes straight.
  std::vector<double> at(double time_s) const {
    std::vector<double> out = position;
    for (std::size_t j = 0; j < out.size(); ++j) {
      out[j] += time_s * velocity[j] + time_s * time_s * bend[j];
    }
    return out;
  }
  std::vector<double> on_path(double time_s) const {
    if (path.empty()) return at(time_s);
    const auto before = std::min(static_cast<std::size_t>(time_s / 0.02), path.size() - 2);
    const double share = time_s / 0.02 - static_cast<double>(before);
    std::vector<double> out = path[before].position;
    for (std::size_t j = 0; j < out.size(); ++j) {
      out[j] += share * (path[before + 1].position[j] - out[j]);
    }
    return out;
  }
  PlannedMotion motion() const { return {velocity, path}; }
};

class Way : public ::testing::Test {
 protected:
  Way() : robot_(arm_on_table()) {
    for (const std::size_t index : robot_->model().evaluated_links) {
      hulls_.push_back(hull_points(robot_->model().links[index].mesh_L));
    }
  }

  RobotPose pose(const std::vector<double>& position) const {
    RobotPose out;
    forward_kinematics(robot_->model(), position, out);
    return out;
  }
  /// How far the mesh's vertices are from where a straight line between two poses has them.
  double strays_m(std::size_t i, const RobotPose& a, const RobotPose& b, double share,
                  const RobotPose& at) const {
    const std::size_t link = robot_->model().evaluated_links[i];
    double most_m = 0;
    for (const Eigen::Vector3f& p : robot_->model().links[link].mesh_L.vertices_m) {
      const Eigen::Vector3d p_L = p.cast<double>();
      const Eigen::Vector3d line =
          (1 - share) * (a.X_BL[link] * p_L) + share * (b.X_BL[link] * p_L);
      most_m = std::max(most_m, (at.X_BL[link] * p_L - line).norm());
    }
    return most_m;
  }

  std::shared_ptr<const Robot> robot_;
  std::vector<HullPoints> hulls_;
};

TEST_F(Way, HasThePosesOfTheJoints) {
  for (const bool is_curved : {false, true}) {
    const DrawnWay way(robot_->model().joints.size(), is_curved, 5);
    BrakingPath path(robot_, hulls_);
    ASSERT_TRUE(path.lay(pose(way.position), way.motion(), 0.48));
    for (const int n : {0, 7, BrakingPath::kPieces}) {
      const RobotPose truth = pose(way.on_path(path.time_s(n)));
      for (std::size_t i = 0; i < hulls_.size(); ++i) {
        const Pose& X_BL = truth.X_BL[robot_->model().evaluated_links[i]];
        EXPECT_LT((path.X_BL(i, n).matrix() - X_BL.matrix()).norm(), 1e-9);
      }
    }
  }
}

TEST_F(Way, NoPointStraysFartherThanItSays) {
  constexpr int kBetween = 9;
  double least_use = 1;
  for (std::uint32_t seed = 0; seed < 6; ++seed) {
    const DrawnWay way(robot_->model().joints.size(), seed % 2 == 1, seed);
    BrakingPath path(robot_, hulls_);
    ASSERT_TRUE(path.lay(pose(way.position), way.motion(), 0.71));
    for (int p = 0; p < BrakingPath::kPieces; p += 5) {
      const RobotPose a = pose(way.on_path(path.time_s(p)));
      const RobotPose b = pose(way.on_path(path.time_s(p + 1)));
      for (int k = 1; k < kBetween; ++k) {
        const double share = static_cast<double>(k) / kBetween;
        const double time_s = path.time_s(p) + share * (path.time_s(p + 1) - path.time_s(p));
        const RobotPose at = pose(way.on_path(time_s));
        for (std::size_t i = 1; i < hulls_.size(); ++i) {
          const double strays = strays_m(i, a, b, share, at);
          EXPECT_LE(strays, path.bend_m(i, p) + 1e-6) << seed << ' ' << p << ' ' << i;
          if (i == 7 && k == 4) least_use = std::min(least_use, strays / path.bend_m(i, p));
        }
      }
    }
  }
  EXPECT_GT(least_use, 0.01) << "the bound is of the size of what it bounds";
}

TEST_F(Way, TheFastestPointsWayLiesBetweenBothBounds) {
  const DrawnWay way(robot_->model().joints.size(), true, 3);
  BrakingPath path(robot_, hulls_);
  ASSERT_TRUE(path.lay(pose(way.position), way.motion(), 0.6));
  constexpr int kSteps = 2400;
  double way_m = 0;
  RobotPose before = pose(way.position);
  for (int k = 1; k <= kSteps; ++k) {
    const RobotPose now = pose(way.on_path(0.6 * k / kSteps));
    double step_m = 0;
    for (std::size_t i = 1; i < hulls_.size(); ++i) {
      const std::size_t link = robot_->model().evaluated_links[i];
      for (const Eigen::Vector3f& p : hulls_[i].points_L_m) {
        const Eigen::Vector3d p_L = p.cast<double>();
        step_m = std::max(step_m, (now.X_BL[link] * p_L - before.X_BL[link] * p_L).norm());
      }
    }
    way_m += step_m;
    before = now;
    if (k % (kSteps / BrakingPath::kPieces) != 0) continue;
    const int n = k / (kSteps / BrakingPath::kPieces);
    EXPECT_LE(way_m, path.most_way_m(n) + 1e-6) << n;
    // The hull's slack makes chords longer than they are.
    EXPECT_GE(way_m * 1.01 + 1e-3 * n, path.way_m(n)) << n;
  }
}

TEST_F(Way, IsNotKnownBeyondAPathThatGoesOn) {
  DrawnWay way(robot_->model().joints.size(), true, 3);
  BrakingPath path(robot_, hulls_);
  const RobotPose now = pose(way.position);
  EXPECT_FALSE(path.lay(now, way.motion(), 0.81));
  way.path.push_back({0.82, way.path.back().position});
  EXPECT_TRUE(path.lay(now, way.motion(), 0.9)) << "the robot stands at its end";
  way.path[4].position[2] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(path.lay(now, way.motion(), 0.5));
  way.path[4] = {0.02, way.path[3].position};
  EXPECT_FALSE(path.lay(now, way.motion(), 0.5)) << "stamps go back";
}

}  // namespace
}  // namespace berth
