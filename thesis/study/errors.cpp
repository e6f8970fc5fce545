#include "thesis/study/errors.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace berth::lab {

void Spread::add(double value) {
  ++count;
  sum += value;
  sum_of_squares += value * value;
  greatest = std::max(greatest, value);
}

double Spread::deviation() const {
  return std::sqrt(std::max(0.0, sum_of_squares / count - mean() * mean()));
}

LinkErrors errors_of(const LinkDistances& truth, const LinkDistances& answer, double range_m) {
  assert(truth.links.size() == answer.links.size());
  LinkErrors errors;
  for (std::size_t i = 0; i < truth.links.size(); ++i) {
    const LinkDistance& right = truth.links[i];
    const LinkDistance& found = answer.links[i];
    if (right.status != LinkStatus::ok || right.distance_m > static_cast<float>(range_m)) continue;
    ++errors.links_in_range;
    if (found.status != LinkStatus::ok) {
      ++errors.links_missed;
      continue;
    }
    const auto apart_mm = [](const Eigen::Vector3f& a_m, const Eigen::Vector3f& b_m) {
      return 1000.0 * (a_m - b_m).norm();
    };
    errors.distance_mm.add(1000.0 * std::abs(found.distance_m - right.distance_m));
    errors.robot_point_mm.add(apart_mm(found.robot_point_C_m, right.robot_point_C_m));
    errors.obstacle_point_mm.add(apart_mm(found.obstacle_point_C_m, right.obstacle_point_C_m));
  }
  return errors;
}

}  // namespace berth::lab
