#pragma once

#include <vector>

#include "berth/robot/kinematics.hpp"
#include "berth/separation/link_speed.hpp"
#include "lab/closed_loop/path.hpp"

namespace berth::lab {

/// The arm, on its path at a share of its full speed, or led by velocities of its joints.
class MovingArm {
 public:
  /// `model` has to outlive it; `first_phase`, of a cycle.
  MovingArm(const RobotModel& model, double first_phase);

  /// Goes on for a while, with brake or motor towards the commanded share, 0 to 1, of the path's
  /// speed.
  void step(double commanded_share, double step_s);
  /// The same without the path, towards these velocities of the joints. Where they are a share of
  /// what it has, or 0, it stays on its way.
  void lead(const std::vector<double>& velocity_rad_s, double step_s);

  /// Puts it at this place of its path.
  void go_to(double phase_s);

  /// Where its path is, and how fast it would go there at full speed.
  const PathPoint& plan() const { return plan_; }
  const RobotPose& pose() const { return pose_; }
  const std::vector<double>& position_rad() const { return position_rad_; }
  /// How far it has come, as a time at full speed.
  double phase_s() const { return phase_s_; }
  /// Of its fastest point, now.
  double fastest_m_s() const { return fastest_m_s_; }
  /// The same at full speed.
  double full_m_s() const { return full_m_s_; }

 private:
  void place();
  /// Of the fastest point, at these joint velocities.
  double fastest_at(const std::vector<double>& velocity_rad_s);

  const RobotModel& model_;
  std::vector<HullPoints> hulls_;
  double phase_s_;
  double share_ = 0;
  PathPoint plan_;
  RobotPose pose_;
  std::vector<double> position_rad_;
  std::vector<double> velocity_rad_s_;
  std::vector<double> change_rad_s_;
  std::vector<LinkTwist> twists_;
  /// Of its fastest point on the path at full speed.
  double full_m_s_ = 0;
  double fastest_m_s_ = 0;
};

}  // namespace berth::lab
