// Places of people and arms over time.
#pragma once

#include <vector>

#include "sim/arm.hpp"

namespace berth::sim {

/// Minimum-jerk step from 0 at `begin` to 1 at `end`.
double smooth_step(double begin, double end, double t);

/// A row of joints.csv.
struct JointRow {
  double time_s;
  JointAngles angle_rad;
};

/// Smooth motion of all seven joints at 100 Hz, rounded as the file's text is.
std::vector<JointRow> make_joint_rows();

/// The arm at a time between two rows, linear between them.
JointAngles interpolate(const std::vector<JointRow>& rows, double time_s);

/// The times at which a camera exposes, the first at first_s; in whole milliseconds.
std::vector<double> exposures_s(double first_s, int per_second, int count);

/// The person's intention at a time; all smooth.
struct PersonMotion {
  double x_T_m;     ///< where the hips are
  double walked_m;  ///< way that the legs have gone
  double lean_rad;  ///< of the trunk, forward
  double reach;     ///< of the left hand: 0 hangs down, 1 is at reached_wrist_T_m
  /// By default at the arm.
  Eigen::Vector3d reached_wrist_T_m = {0.765, -0.16, 0.44};
};
PersonMotion person_motion(double time_s);

}  // namespace berth::sim
