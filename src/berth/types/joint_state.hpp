#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>
#include <vector>

namespace berth {

/// Whether these are the numbers of this count of joints, none of them NaN or infinite.
inline bool are_finite(std::span<const double> numbers, std::size_t joints) {
  return numbers.size() == joints &&
         std::ranges::all_of(numbers, [](double number) { return std::isfinite(number); });
}

/// Joint positions at one time, in the order of RobotModel::joints; rad, or m for prismatic joints.
struct JointState {
  double stamp_s = 0;
  std::vector<double> position;
};

}  // namespace berth
