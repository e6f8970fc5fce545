#include "lab/closed_loop/path.hpp"

#include <array>
#include <cmath>

#include "sim/arm.hpp"

namespace berth::lab {
namespace {

struct Stop {
  sim::JointAngles position_rad;
  /// From here to the next one.
  double duration_s;
};

constexpr sim::JointAngles kTakeLow{-0.9, 0.75, 0.0, -1.35, 0.0, 1.05, 0.4};
constexpr sim::JointAngles kTakeHigh{-0.9, 0.45, 0.0, -1.35, 0.0, 1.25, 0.4};
constexpr sim::JointAngles kPutHigh{0.9, 0.45, 0.0, -1.35, 0.0, 1.25, -0.4};
constexpr sim::JointAngles kPutLow{0.9, 0.75, 0.0, -1.35, 0.0, 1.05, -0.4};

constexpr std::array<Stop, 6> kStops{{{kTakeLow, 0.6},
                                      {kTakeHigh, 1.5},
                                      {kPutHigh, 0.6},
                                      {kPutLow, 0.6},
                                      {kPutHigh, 1.5},
                                      {kTakeHigh, 0.6}}};

}  // namespace

double cycle_s() {
  double sum_s = 0;
  for (const Stop& stop : kStops) sum_s += stop.duration_s;
  return sum_s;
}

PathPoint path_at(double phase_s) {
  double rest_s = std::fmod(phase_s, cycle_s());
  std::size_t i = 0;
  while (i + 1 < kStops.size() && rest_s >= kStops[i].duration_s) rest_s -= kStops[i++].duration_s;
  const Stop &from = kStops[i], &to = kStops[(i + 1) % kStops.size()];
  // Minimum jerk.
  const double u = rest_s / from.duration_s;
  const double way = u * u * u * (10 + u * (6 * u - 15));
  const double slope = 30 * u * u * (1 + u * (u - 2)) / from.duration_s;
  PathPoint point;
  for (int j = 0; j < sim::kArmJoints; ++j) {
    const double step = to.position_rad[j] - from.position_rad[j];
    point.position_rad.push_back(from.position_rad[j] + way * step);
    point.velocity_rad_s.push_back(slope * step);
  }
  return point;
}

}  // namespace berth::lab
