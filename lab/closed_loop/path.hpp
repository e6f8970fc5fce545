// What the arm does all day: takes something up on one side and puts it down on the other.
#pragma once

#include <vector>

namespace berth::lab {

/// One time around, at full speed.
double cycle_s();

/// Joints of the bundled arm on their way, and how fast they are there at full speed.
struct PathPoint {
  std::vector<double> position_rad;
  std::vector<double> velocity_rad_s;
};

/// `phase_s` is the time on the way at full speed; it goes on after a cycle. Position and velocity
/// are continuous.
PathPoint path_at(double phase_s);

}  // namespace berth::lab
