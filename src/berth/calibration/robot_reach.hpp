// How far a robot reaches.
#pragma once

#include <Eigen/Core>
#include <random>

namespace berth {

/// The same numbers with every standard library, which its distributions do not give.
class RepeatableRandom {
 public:
  double operator()(double low, double high) {
    return low + (high - low) * static_cast<double>(engine_()) / static_cast<double>(engine_.max());
  }

 private:
  std::mt19937 engine_{1};
};

struct RobotModel;

/// A ball in the base frame B that the links stay in that joints move.
struct RobotReach {
  Eigen::Vector3d center_B_m = Eigen::Vector3d::Zero();
  double radius_m = 0;
};

/// Of joint positions drawn within their limits; without limits, within a turn, and at 0 where it
/// slides. Radius 0 where no joint moves a link that has a shape.
RobotReach robot_reach(const RobotModel& model);

}  // namespace berth
