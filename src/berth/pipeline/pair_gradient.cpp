#include "berth/pipeline/pair_gradient.hpp"

#include <algorithm>

#include "berth/robot/kinematics.hpp"

namespace berth {

PointsOfPair points_of(const SpacePair& pair) {
  return {pair.is_known(), pair.distance_m, pair.robot_point_B_m.cast<double>(),
          pair.obstacle_point_B_m.cast<double>(), std::nullopt};
}

PointsOfPair points_of(const KnownPair& pair) {
  return {pair.is_known(), pair.distance_m, pair.robot_point_B_m.cast<double>(),
          pair.obstacle_point_B_m.cast<double>(), static_cast<std::size_t>(pair.link)};
}

PairGradient::PairGradient(const RobotModel& model) : model_(model) {
  const auto joints = static_cast<Eigen::Index>(model.joints.size());
  gradient_.resize(joints);
  of_link_.resize(3, joints);
  of_other_.resize(3, joints);
}

const Eigen::RowVectorXd& PairGradient::find(const RobotPose& pose, std::size_t link,
                                             const PointsOfPair& pair) {
  gradient_.setZero();
  const Eigen::Vector3d way_B_m = pair.link_B_m - pair.other_B_m;
  const double length_m = way_B_m.norm();
  normal_B_.setZero();
  if (pair.distance_m == 0 || length_m == 0) return gradient_;
  normal_B_ = way_B_m / length_m;
  point_jacobian(model_, pose, link, pair.link_B_m, of_link_);
  if (pair.other) {
    point_jacobian(model_, pose, *pair.other, pair.other_B_m, of_other_);
    of_link_ -= of_other_;
  }
  gradient_.noalias() = normal_B_.transpose() * of_link_;
  return gradient_;
}

template <class Pair>
void PairGradient::tell(const Result& result, const LinkResult& link, Pair& pair) {
  pair.gradient.assign(model_.joints.size(), std::numeric_limits<float>::quiet_NaN());
  if (!pair.is_known()) return;
  const std::size_t index = model_.evaluated_links[link.id - 1];
  const Eigen::RowVectorXd& gradient = find(result.pose, index, points_of(pair));
  // 0 and not -0, which people would ask about.
  for (std::size_t j = 0; j < pair.gradient.size(); ++j) {
    pair.gradient[j] = static_cast<float>(gradient[static_cast<Eigen::Index>(j)] + 0.0);
  }
}

void PairGradient::tell(Result& out) {
  for (LinkResult& link : out.links) {
    tell<ToldPair>(out, link, link);
    tell(out, link, link.occupied);
    tell(out, link, link.known);
    for (ToldPair& pair : link.candidates) tell(out, link, pair);
  }
}

}  // namespace berth
