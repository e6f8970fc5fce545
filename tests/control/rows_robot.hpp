// Robots of the tests of rows, and their distances to what is known.
#pragma once

#include "berth/control/distance_rows.hpp"
#include "berth/distance/known_distances.hpp"
#include "berth/pipeline/query.hpp"
#include "sim/random.hpp"
#include "tests/support/known_arms.hpp"

namespace berth {

inline EvaluationSettings with_candidates(int candidates) {
  EvaluationSettings settings;
  settings.candidates = candidates;
  return settings;
}

/// A robot with distances to what is known, and no camera.
class RowsRobot {
 public:
  explicit RowsRobot(const RobotSettings& settings, int candidates = 1)
      : robot(std::make_shared<const Robot>(load_robot(settings), with_candidates(candidates))) {
    begin_result(*robot, result);
  }

  const RobotModel& model() const { return robot->model(); }

  std::vector<double> draw_positions(sim::Random& random) const {
    std::vector<double> positions;
    for (const MovableJoint& joint : model().joints) {
      const bool is_limited = std::isfinite(joint.upper - joint.lower);
      positions.push_back(is_limited ? random(joint.lower, joint.upper) : random(-3, 3));
    }
    return positions;
  }

  /// Sets pose and known pairs of the result; the cameras see nothing.
  void ask(const std::vector<double>& positions, double tolerance_m = 1e-3) {
    forward_kinematics(model(), positions, result.pose);
    known_distances(robot->known(), result.pose, {.range_m = 1, .tolerance_m = tolerance_m},
                    workspace, pairs);
    for (std::size_t i = 0; i < pairs.size(); ++i) {
      LinkResult& link = result.links[i];
      static_cast<SpacePair&>(link) = link.occupied = SpacePair();
      link.lower_bound_m = 1;
      link.status = LinkStatus::none_in_range;
      link.known = pairs[i];
    }
    result.status = ResultStatus::ok;
  }

  std::shared_ptr<const Robot> robot;
  Result result;
  KnownWorkspace workspace;
  std::vector<KnownPair> pairs;
};

/// Puts what the cameras see at a point, nearest to that point of a link.
inline void put(RowsRobot& robot, std::size_t i, const Eigen::Vector3d& p_L_m,
                const Eigen::Vector3d& obstacle_B_m, SpacePair& pair) {
  const Eigen::Vector3d p_B_m = robot.result.pose.X_BL[robot.model().evaluated_links[i]] * p_L_m;
  pair.robot_point_B_m = p_B_m.cast<float>();
  pair.obstacle_point_B_m = obstacle_B_m.cast<float>();
  pair.distance_m = (pair.robot_point_B_m - pair.obstacle_point_B_m).norm();
  pair.lower_bound_m = pair.distance_m - 1e-3F;
  pair.camera = 0;
}

}  // namespace berth
