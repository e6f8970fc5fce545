// How the distance of a pair changes with the joints.
#pragma once

#include <Eigen/Core>
#include <optional>

#include "berth/pipeline/result.hpp"

namespace berth {

/// The points of a pair, in frame B, and where the other one is fixed.
struct PointsOfPair {
  bool is_known = false;
  double distance_m = 0;
  Eigen::Vector3d link_B_m;
  Eigen::Vector3d other_B_m;
  /// In RobotModel::links; none for what the cameras see.
  std::optional<std::size_t> other;
};
PointsOfPair points_of(const SpacePair& pair);
PointsOfPair points_of(const KnownPair& pair);

/// One for each thread; once made, nothing allocates.
class PairGradient {
 public:
  /// `model` has to outlive it.
  explicit PairGradient(const RobotModel& model);

  /// d(distance)/dq of a known pair of a link (RobotModel::links), in m/rad, or m/m where the joint
  /// slides, one number for each joint: normal_B() times how the joint moves the one point against
  /// the other. 0 where they touch.
  const Eigen::RowVectorXd& find(const RobotPose& pose, std::size_t link, const PointsOfPair& pair);
  /// Of the last pair: of length 1, from the other point to the link's; 0 where they touch.
  const Eigen::Vector3d& normal_B() const { return normal_B_; }

  /// Writes the gradients of all pairs of an answer.
  void tell(Result& out);

 private:
  template <class Pair>
  void tell(const Result& result, const LinkResult& link, Pair& pair);

  const RobotModel& model_;
  Eigen::Vector3d normal_B_ = Eigen::Vector3d::Zero();
  Eigen::RowVectorXd gradient_;
  Eigen::Matrix3Xd of_link_;
  Eigen::Matrix3Xd of_other_;
};

}  // namespace berth
