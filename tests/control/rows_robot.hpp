// Robots of the tests of rows, and their distances to what is known.
#pragma once

#include <cstdlib>
#include <string_view>

#include "berth/control/distance_rows.hpp"
#include "berth/distance/known_distances.hpp"
#include "berth/pipeline/query.hpp"
#include "sim/random.hpp"
#include "tests/support/known_arms.hpp"
#include "tests/support/thinned.hpp"

namespace berth {

/// A hundredth of so many cases, unless BERTH_CONTROL_TWIN=full is in the environment.
inline int cases(int full) {
  const char* const set = std::getenv("BERTH_CONTROL_TWIN");
  return set && set == std::string_view("full") ? full : thinned(full / 100);
}

/// A robot with distances to what is known, and no camera.
class RowsRobot {
 public:
  explicit RowsRobot(const RobotSettings& settings)
      : robot(std::make_shared<const Robot>(load_robot(settings))) {
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

  /// Sets pose and known pairs of the result.
  void ask(const std::vector<double>& positions, double tolerance_m = 1e-3) {
    forward_kinematics(model(), positions, result.pose);
    known_distances(robot->known(), result.pose, {.range_m = 1, .tolerance_m = tolerance_m},
                    workspace, pairs);
    for (std::size_t i = 0; i < pairs.size(); ++i) result.links[i].known = pairs[i];
    result.time.status = TimeStatus::ok;
  }

  std::shared_ptr<const Robot> robot;
  Result result;
  KnownWorkspace workspace;
  std::vector<KnownPair> pairs;
};

}  // namespace berth
