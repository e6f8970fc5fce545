// How an encounter went, against the truth at each millisecond.
#pragma once

#include <limits>
#include <vector>

#include "sim/true_clearance.hpp"

namespace berth::sim {

/// An arm whose fastest point is slower stands still.
inline constexpr double kMoving_m_s = 1e-4;

/// Arm and person at one time.
struct ContactSample {
  double time_s;
  RobotPose pose;
  std::vector<Pose> X_BP;
  /// Of the arm's fastest point.
  double fastest_m_s;
};

/// Finds the least distance while the arm moved, and how fast it was where both met. FCL takes
/// milliseconds, so it is asked where a bound does not decide.
class ContactCheck {
 public:
  /// Arm and person come nearer by less than fastest_m_s.
  explicit ContactCheck(const TrueClearance& clearance, double fastest_m_s = 5)
      : clearance_(clearance), fastest_m_s_(fastest_m_s) {}

  /// Whether a sample of this time can add anything; if so, call add().
  bool is_due(double time_s) const { return time_s >= next_s_; }
  void add(ContactSample sample);
  /// Asks FCL for all that is still open.
  void finish();

  /// Infinite where the arm never moved.
  double least_moving_m() const { return least_moving_m_; }
  /// Of the fastest point of an arm that moved while both met; 0 where that never was.
  double contact_m_s() const { return contact_m_s_; }
  bool has_touched() const { return has_touched_; }

 private:
  struct Open {
    double at_least_m;
    ContactSample sample;
  };
  void measure(const ContactSample& sample);

  const TrueClearance& clearance_;
  double fastest_m_s_;
  std::vector<Open> open_;
  double next_s_ = 0;
  double least_moving_m_ = std::numeric_limits<double>::infinity();
  double contact_m_s_ = 0;
  bool has_touched_ = false;
};

}  // namespace berth::sim
