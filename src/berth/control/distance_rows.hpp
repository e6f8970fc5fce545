#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <memory>
#include <string_view>
#include <vector>

#include "berth/pipeline/pair_gradient.hpp"
#include "berth/pipeline/result.hpp"
#include "berth/pipeline/robot.hpp"

namespace berth {

struct ChainJoint;

/// Which pair of a link a row is about.
enum class RowKind : std::uint8_t {
  nearest,   ///< LinkResult itself and its candidates: occupied or unknown
  occupied,  ///< LinkResult::occupied
  known,     ///< LinkResult::known
};
inline constexpr std::array kRowKinds = {RowKind::nearest, RowKind::occupied,
                                         RowKind::known};  ///< all of them
/// By enumerator.
inline constexpr std::array<std::string_view, 3> kRowKindNames = {"nearest", "occupied", "known"};
constexpr std::string_view name_of(RowKind kind) {
  return kRowKindNames[static_cast<std::size_t>(kind)];
}

/// A row for each link (Result::links), a column for each joint (RobotModel::joints).
using LinksByJoints = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
/// A vector for each link.
using LinkVectors = Eigen::Matrix<double, Eigen::Dynamic, 3, Eigen::RowMajor>;

/// How the distances of a result change with the joints: what an optimiser needs beside them. One
/// for each thread; once made, nothing allocates.
class DistanceRows {
 public:
  explicit DistanceRows(std::shared_ptr<const Robot> robot);
  ~DistanceRows();

  /// The result is one of this robot; else std::invalid_argument.
  void update(const Result& result);

  /// d(distance)/dq, in m/rad, or m/m where the joint slides: the unit vector from the obstacle's
  /// point of the pair to the link's, times how the joint moves the one point against the other.
  /// NaN where there is no pair. 0 in contact: the distance gives no direction there. At a kink,
  /// where two pairs are as near, it is that of one of them. Of RowKind::nearest there are as many
  /// as EvaluationSettings::candidates says: 0 is the link's own pair, k is
  /// LinkResult::candidates[k - 1]. Of other kinds there is 0 alone. Else std::out_of_range.
  const LinksByJoints& gradient(RowKind kind, int candidate = 0) const {
    return gradients_[index(kind, candidate)];
  }

  /// Of length 1, from the obstacle's point of the pair to the link's, in the robot's root frame B:
  /// where the link goes away. In contact it is that of the last result in which they were apart.
  /// NaN where there is no pair, or none was apart before.
  const LinkVectors& normal_B(RowKind kind, int candidate = 0) const {
    return normals_B_[index(kind, candidate)];
  }

  /// What a motion can cost at most: after any step dq of the joints, however large, nothing of
  /// this kind is nearer than
  ///   lower_bound_m - sum over joints j of |dq_j| reach_m(j)
  /// Turn first, then slide: while joints turn, no point of the link is farther from an axis than
  /// the joints' and the link's lengths together; a slide moves each point by |dq_j|. A joint that
  /// moves a link and the other one of a `known` pair alike costs that pair nothing.
  const LinksByJoints& reach_m(RowKind kind) const {
    return kind == RowKind::known ? known_reach_m_ : reach_m_;
  }

 private:
  /// Candidates come behind the pairs of all kinds.
  std::size_t index(RowKind kind, int candidate) const;
  void differentiate(const Result& result, std::size_t link, RowKind kind, int candidate);
  void find_reaches(const RobotPose& pose);
  void add_reach(std::size_t body, std::size_t common, Eigen::VectorXd& sum_m) const;
  /// How many joints at the ends of both chains are the same.
  std::size_t common_joints(std::size_t body, std::size_t other) const;

  std::shared_ptr<const Robot> robot_;
  std::vector<LinksByJoints> gradients_;
  std::vector<LinkVectors> normals_B_;
  LinksByJoints reach_m_;
  LinksByJoints known_reach_m_;
  /// Of the bodies of KnownModel: the evaluated links come first, by their ids.
  std::vector<std::vector<ChainJoint>> chains_;
  std::vector<double> radius_m_;
  bool has_slides_ = false;
  Eigen::VectorXd sum_m_;
  PairGradient of_pair_;
};

}  // namespace berth
