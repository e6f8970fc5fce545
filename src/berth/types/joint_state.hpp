#pragma once

#include <vector>

namespace berth {

/// Joint positions at one time, in the order of RobotModel::joints; rad, or m for prismatic joints.
struct JointState {
  double stamp_s = 0;
  std::vector<double> position;
};

}  // namespace berth
