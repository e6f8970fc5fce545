#include "berth/types/guarded_box.hpp"

#include <algorithm>

namespace berth {

bool GuardedBox::holds(const Eigen::Vector3d& p_B_m, double reach_m) const {
  const Eigen::Matrix3d R_GB = X_BG.linear().transpose();
  const Eigen::Array3d off_m = (R_GB * (p_B_m - X_BG.translation())).cwiseAbs();
  return (off_m + reach_m * R_GB.cwiseAbs().rowwise().sum().array() <= half_m.array()).all();
}

bool is_in_one(std::span<const GuardedBox> boxes, const Eigen::Vector3d& p_B_m, double reach_m) {
  return std::ranges::any_of(boxes,
                             [&](const GuardedBox& box) { return box.holds(p_B_m, reach_m); });
}

}  // namespace berth
