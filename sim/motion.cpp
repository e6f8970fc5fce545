#include "sim/motion.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace berth::sim {
namespace {

constexpr int kRowCount = 371;
constexpr int kRowsPerSecond = 100;

/// mean + amplitude sin(2 pi time / period + phase)
struct Swing {
  double mean_rad, amplitude_rad, period_s, phase_rad;
};
constexpr std::array<Swing, kArmJoints> kSwings{{{0.05, 0.32, 3.9, 0.4},
                                                 {0.42, 0.16, 3.1, 1.9},
                                                 {0.10, 0.28, 4.7, 2.8},
                                                 {-1.50, 0.24, 3.6, 0.0},
                                                 {0.15, 0.40, 2.9, 4.0},
                                                 {1.05, 0.26, 3.3, 1.1},
                                                 {0.00, 0.90, 4.1, 5.0}}};

double round_to(double value, double step) { return std::round(value / step) * step; }

}  // namespace

double smooth_step(double begin, double end, double t) {
  const double s = std::clamp((t - begin) / (end - begin), 0.0, 1.0);
  return s * s * s * (10 + s * (6 * s - 15));
}

std::vector<JointRow> make_joint_rows() {
  std::vector<JointRow> rows(kRowCount);
  for (int r = 0; r < kRowCount; ++r) {
    rows[r].time_s = static_cast<double>(r) / kRowsPerSecond;
    for (int j = 0; j < kArmJoints; ++j) {
      const Swing& swing = kSwings[j];
      const double angle = 2 * std::numbers::pi * rows[r].time_s / swing.period_s + swing.phase_rad;
      rows[r].angle_rad[j] = round_to(swing.mean_rad + swing.amplitude_rad * std::sin(angle), 1e-6);
    }
  }
  return rows;
}

JointAngles interpolate(const std::vector<JointRow>& rows, double time_s) {
  const auto after = std::upper_bound(rows.begin() + 1, rows.end() - 1, time_s,
                                      [](double t, const JointRow& row) { return t < row.time_s; });
  const JointRow &a = *(after - 1), &b = *after;
  const double s = (time_s - a.time_s) / (b.time_s - a.time_s);
  JointAngles angle_rad;
  for (int j = 0; j < kArmJoints; ++j)
    angle_rad[j] = a.angle_rad[j] + s * (b.angle_rad[j] - a.angle_rad[j]);
  return angle_rad;
}

std::vector<double> exposures_s(double first_s, int per_second, int count) {
  std::vector<double> stamps_s(count);
  for (int k = 0; k < count; ++k)
    stamps_s[k] = round_to(first_s + static_cast<double>(k) / per_second, 1e-3);
  return stamps_s;
}

PersonMotion person_motion(double time_s) {
  const double walk = smooth_step(0.0, 1.7, time_s) - smooth_step(2.3, 3.7, time_s);
  const double walked = smooth_step(0.0, 1.7, time_s) + smooth_step(2.3, 3.7, time_s);
  const double reach = smooth_step(0.7, 1.9, time_s) - smooth_step(2.2, 3.2, time_s);
  PersonMotion motion;
  motion.x_T_m = 1.72 - 0.55 * walk;
  motion.walked_m = 0.55 * walked;
  motion.lean_rad = 0.28 * reach;
  motion.reach = reach;
  return motion;
}

}  // namespace berth::sim
