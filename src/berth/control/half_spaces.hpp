// Inside control/ only: the nearest point that a set of linear rows allows.
#pragma once

#include <Eigen/Core>
#include <vector>

namespace berth {

/// Half-spaces n . x >= b, and the point nearest to a wanted one that lies in all of them: the dual
/// method of Goldfarb and Idnani (1983), for a Hessian that is the identity. It begins at the
/// wanted point and takes up one broken row after another, so that it ends soon where few rows
/// matter. Made for up to 20 unknowns and 200 rows. Once made, nothing allocates.
class HalfSpaces {
 public:
  HalfSpaces(Eigen::Index unknowns, Eigen::Index most_rows);

  void clear() { count_ = 0; }
  /// Returns the number of the row. At most `most_rows`; all numbers finite.
  Eigen::Index add(const Eigen::Ref<const Eigen::VectorXd>& normal, double bound);
  Eigen::Index count() const { return count_; }

  /// Whether there is a point that lies in all of them, each to kTolerance of its normal's length;
  /// then it is point().
  bool project(const Eigen::Ref<const Eigen::VectorXd>& wanted);
  const Eigen::VectorXd& point() const { return x_; }
  /// Of each row, 0 or more. Where there is a point, it is wanted + sum weight n, and rows with a
  /// weight hold as n . x = b. Where there is none, sum weight n is 0 and sum weight b above it:
  /// these rows contradict one another. All 0 where rounding stopped the search, without a point.
  Eigen::Ref<const Eigen::VectorXd> weights() const { return weights_.head(count_); }

  static constexpr double kTolerance = 1e-9;

 private:
  using Rows = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  enum class Taken { up, not_at_all, for_good };

  /// The row that is broken most; -1: none is.
  Eigen::Index find_broken();
  /// Moves until the row holds, and lets go of rows that it does not need any more. Returns whether
  /// a point may hold it and those that it kept.
  bool take_up(Eigen::Index row);
  void split(Eigen::Index row);
  void insert(Eigen::Index row, double weight);
  void let_go(Eigen::Index active);
  void report(Eigen::Index broken);

  /// Normals have length 1; those that had none keep 0.
  Rows normals_;
  Eigen::VectorXd bounds_;
  Eigen::VectorXd lengths_;
  Eigen::Index count_ = 0;
  Eigen::VectorXd x_;
  /// The active rows and their weights; their normals are the first columns of Q times R.
  std::vector<Eigen::Index> active_;
  Eigen::VectorXd active_weights_;
  Eigen::MatrixXd q_;
  Eigen::MatrixXd r_;
  /// Of the row that is taken up: its normal in Q; where x goes; how the active weights fall.
  Eigen::VectorXd in_q_;
  Eigen::VectorXd way_;
  Eigen::VectorXd fall_;
  Eigen::VectorXd slack_;
  Eigen::VectorXd weights_;
};

}  // namespace berth
