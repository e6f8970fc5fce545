#include "berth/control/half_spaces.hpp"

#include <Eigen/Jacobi>
#include <algorithm>
#include <limits>

namespace berth {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
/// A row whose normal has less than this outside of the active ones' span depends on them.
constexpr double kDependent = 1e-9;

}  // namespace

HalfSpaces::HalfSpaces(Eigen::Index unknowns, Eigen::Index most_rows)
    : normals_(most_rows, unknowns),
      bounds_(most_rows),
      lengths_(most_rows),
      x_(unknowns),
      active_weights_(unknowns),
      q_(unknowns, unknowns),
      r_(unknowns, unknowns),
      in_q_(unknowns),
      way_(unknowns),
      fall_(unknowns),
      slack_(most_rows),
      weights_(most_rows) {
  r_.setZero();
  active_.reserve(static_cast<std::size_t>(unknowns));
}

Eigen::Index HalfSpaces::add(const Eigen::Ref<const Eigen::VectorXd>& normal, double bound) {
  const double length = normal.norm();
  lengths_[count_] = length > 0 ? length : 1;
  normals_.row(count_) = normal.transpose() / lengths_[count_];
  bounds_[count_] = bound / lengths_[count_];
  return count_++;
}

bool HalfSpaces::project(const Eigen::Ref<const Eigen::VectorXd>& wanted) {
  x_ = wanted;
  active_.clear();
  q_.setIdentity();
  // Each row that is taken up brings x farther from what is wanted: none comes twice with the same
  // ones beside it. Rounding alone might go on for ever.
  constexpr Eigen::Index kMostOfEach = 20;
  for (Eigen::Index i = 0; i < kMostOfEach * (count_ + 1); ++i) {
    const Eigen::Index broken = find_broken();
    if (broken < 0 || !take_up(broken)) {
      report(broken);
      return broken < 0;
    }
  }
  weights_.setZero();
  return false;
}

Eigen::Index HalfSpaces::find_broken() {
  if (count_ == 0) return -1;
  auto slack = slack_.head(count_);
  slack.noalias() = normals_.topRows(count_) * x_;
  slack -= bounds_.head(count_);
  // Rounding must not take one up that is active.
  for (const Eigen::Index row : active_) slack[row] = 0;
  Eigen::Index broken = -1;
  return slack.minCoeff(&broken) < -kTolerance ? broken : -1;
}

void HalfSpaces::split(Eigen::Index row) {
  const auto active = static_cast<Eigen::Index>(active_.size());
  const Eigen::Index free = x_.size() - active;
  in_q_.noalias() = q_.transpose() * normals_.row(row).transpose();
  way_.noalias() = q_.rightCols(free) * in_q_.tail(free);
  fall_.head(active) = in_q_.head(active);
  for (Eigen::Index k = active - 1; k >= 0; --k) {
    for (Eigen::Index c = k + 1; c < active; ++c) fall_[k] -= r_(k, c) * fall_[c];
    fall_[k] /= r_(k, k);
  }
}

bool HalfSpaces::take_up(Eigen::Index row) {
  double weight = 0;
  for (;;) {
    split(row);
    const auto active = static_cast<Eigen::Index>(active_.size());
    // How far a step may be until an active row would pull the wrong way, and until the row holds.
    double until_free = kInfinity;
    Eigen::Index freed = -1;
    for (Eigen::Index k = 0; k < active; ++k) {
      if (fall_[k] <= kTolerance || active_weights_[k] / fall_[k] >= until_free) continue;
      until_free = active_weights_[k] / fall_[k];
      freed = k;
    }
    const bool depends = active == x_.size() || way_.norm() < kDependent;
    const double broken = bounds_[row] - normals_.row(row).dot(x_);
    const double until_held = depends ? kInfinity : std::max(0.0, broken) / way_.squaredNorm();
    const double step = std::min(until_free, until_held);
    if (step == kInfinity) return false;
    x_ += step * way_;
    active_weights_.head(active) -= step * fall_.head(active);
    weight += step;
    if (until_held <= until_free) {
      insert(row, weight);
      return true;
    }
    let_go(freed);
  }
}

void HalfSpaces::insert(Eigen::Index row, double weight) {
  const auto active = static_cast<Eigen::Index>(active_.size());
  for (Eigen::Index k = x_.size() - 1; k > active; --k) {
    Eigen::JacobiRotation<double> turn;
    turn.makeGivens(in_q_[k - 1], in_q_[k]);
    in_q_.applyOnTheLeft(k - 1, k, turn.adjoint());
    q_.applyOnTheRight(k - 1, k, turn);
  }
  r_.col(active).head(active + 1) = in_q_.head(active + 1);
  active_weights_[active] = weight;
  active_.push_back(row);
}

void HalfSpaces::let_go(Eigen::Index freed) {
  const auto active = static_cast<Eigen::Index>(active_.size());
  active_.erase(active_.begin() + freed);
  for (Eigen::Index k = freed; k + 1 < active; ++k) {
    active_weights_[k] = active_weights_[k + 1];
    r_.col(k).head(k + 2) = r_.col(k + 1).head(k + 2);
    Eigen::JacobiRotation<double> turn;
    turn.makeGivens(r_(k, k), r_(k + 1, k));
    r_.applyOnTheLeft(k, k + 1, turn.adjoint());
    q_.applyOnTheRight(k, k + 1, turn);
  }
}

void HalfSpaces::report(Eigen::Index broken) {
  weights_.setZero();
  const bool is_found = broken < 0;
  for (std::size_t k = 0; k < active_.size(); ++k) {
    const auto at = static_cast<Eigen::Index>(k);
    const double weight = is_found ? active_weights_[at] : -fall_[at];
    weights_[active_[k]] = std::max(0.0, weight) / lengths_[active_[k]];
  }
  if (!is_found) weights_[broken] = 1 / lengths_[broken];
}

}  // namespace berth
