#include "sim/encounter.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "berth/separation/link_speed.hpp"
#include "sim/person.hpp"
#include "sim/random.hpp"

namespace berth::sim {
namespace {

/// From here on all cameras see the person.
constexpr double kFirst_m = 2.2;

const std::vector<HullPoints>& part_hulls() {
  static const std::vector<HullPoints> hulls = [] {
    std::vector<HullPoints> all;
    for (const TriangleMesh& part : make_person_meshes()) all.push_back(hull_points(part, 0.004F));
    return all;
  }();
  return hulls;
}

/// Steps of the person that speeds are taken from.
constexpr int kSteps = 1000;

/// An elbow that turns over in less than a step has no speed that could be given.
bool snaps(const std::vector<double>& steps_m) {
  const auto greatest = std::ranges::max_element(steps_m);
  return *(greatest - 1) < 0.96 * *greatest || *(greatest + 1) < 0.96 * *greatest;
}

/// How far the fastest point of a body gets between two postures.
double greatest_step_m(const std::vector<Pose>& a, const std::vector<Pose>& b) {
  double step_m = 0;
  for (std::size_t part = 0; part < a.size(); ++part) {
    for (const Eigen::Vector3f& p : part_hulls()[part].points_L_m) {
      step_m = std::max(step_m, (a[part] * p.cast<double>() - b[part] * p.cast<double>()).norm());
    }
  }
  return step_m;
}

}  // namespace

Encounter::Encounter(std::uint32_t seed, Reach reach) {
  Random random(seed);
  direction_rad_ = random(-std::numbers::pi, std::numbers::pi);
  nearest_m_ = random(1.05, 1.3);
  if (reach == Reach::to_table) {
    // Where the arm takes things, and where it puts them; the table ends 0.6 m from the base.
    direction_rad_ = std::copysign(0.9, direction_rad_);
    nearer_m_ = 0.25;
  }
  speed_m_s_ = random(1.0, 1.6);
  first_phase_ = random(0, 1);
  std::vector<double> steps_m;
  do {
    if (reach == Reach::to_arm) {
      wrist_m_ = {random(0.45, 0.8), random(-0.35, 0.35), random(0.1, 0.6)};
    } else {
      // The fingers go on from the wrist, down to the table's top.
      wrist_m_ = {nearest_m_ - random(0.34, 0.42), random(-0.25, -0.1), random(0.12, 0.16)};
    }
    steps_m = greatest_steps_m();
  } while (snaps(steps_m));
  unit_s_ = *std::ranges::max_element(steps_m) * kSteps / kUnits / speed_m_s_;
}

std::vector<double> Encounter::greatest_steps_m() const {
  std::vector<double> steps_m;
  for (int i = 0; i < kSteps; ++i) {
    const double from = kUnits * i / kSteps;
    steps_m.push_back(greatest_step_m(pose_in_units(from), pose_in_units(from + kUnits / kSteps)));
  }
  return steps_m;
}

std::vector<Pose> Encounter::pose_at(double time_s) const {
  return pose_in_units(time_s / unit_s_);
}

std::vector<Pose> Encounter::pose_in_units(double t) const {
  const double in = smooth_step(0, 1.3, t), out = smooth_step(1.7, 3.0, t);
  PersonMotion motion;
  motion.x_T_m = kFirst_m + (nearest_m_ - kFirst_m) * (in - out);
  motion.walked_m = (kFirst_m - nearest_m_) * (in + out);
  motion.reach = smooth_step(0.6, 1.5, t) - smooth_step(1.6, 2.5, t);
  motion.lean_rad = 0.28 * motion.reach;
  motion.reached_wrist_T_m = wrist_m_;
  std::vector<Pose> X_BP = person_kinematics(motion);
  const Pose turn = Eigen::AngleAxisd(direction_rad_, Eigen::Vector3d::UnitZ()) *
                    Eigen::Translation3d(-nearer_m_, 0, 0);
  for (Pose& X : X_BP) X = turn * X;
  return X_BP;
}

}  // namespace berth::sim
