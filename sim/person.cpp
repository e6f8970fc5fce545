#include "sim/person.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "sim/room.hpp"

namespace berth::sim {
namespace {

using Eigen::Vector3d;

using std::numbers::pi;

// The body's frame H: on the floor below the hips' middle, x to the front, y to the left, z up.
constexpr double kHipsZ_m = 0.90, kAnkleZ_m = 0.08, kHipY_m = 0.095, kShoulderY_m = 0.195;

// The middle and the end of two bones that reach from `from` towards `to`, bent towards `bend`.
struct TwoBones {
  Vector3d middle, end;
};
TwoBones reach_with_two_bones(const Vector3d& from, const Vector3d& to, double first_m,
                              double second_m, const Vector3d& bend) {
  const Vector3d direction = (to - from).normalized();
  const double distance = std::min((to - from).norm(), 0.995 * (first_m + second_m));
  const double along =
      (distance * distance + first_m * first_m - second_m * second_m) / (2 * distance);
  const Vector3d across = (bend - bend.dot(direction) * direction).normalized();
  const double height = std::sqrt(std::max(0.0, first_m * first_m - along * along));
  return {from + along * direction + height * across, from + distance * direction};
}

// A frame at `from` with z towards `to` and x as near to `side` as can be.
Pose bone_pose(const Vector3d& from, const Vector3d& to, const Vector3d& side) {
  Pose X = Pose::Identity();
  const Vector3d z = (to - from).normalized(), y = z.cross(side).normalized();
  X.linear() << y.cross(z), y, z;
  X.translation() = from;
  return X;
}

void place_arm(std::vector<Pose>& X_TP, const Pose& X_TH, const Vector3d& shoulder,
               const Vector3d& wrist, double left) {
  const Vector3d side = X_TH.linear() * Vector3d(0, -left, 0);
  const Vector3d bend = X_TH.linear() * Vector3d(-0.4, 0.5 * left, -1);
  const TwoBones arm = reach_with_two_bones(shoulder, wrist, kUpperArm_m, kForearm_m, bend);
  X_TP.push_back(bone_pose(shoulder, arm.middle, side));
  X_TP.push_back(bone_pose(arm.middle, arm.end, side));
  X_TP.push_back(bone_pose(arm.end, 2 * arm.end - arm.middle, side));
}

void place_leg(std::vector<Pose>& X_TP, const Pose& X_TH, double left, double stride_phase) {
  const Vector3d hip = X_TH * Vector3d(0, left * kHipY_m, kHipsZ_m);
  const double lift = 0.05 * std::max(0.0, std::cos(stride_phase));
  const Vector3d ankle =
      X_TH * Vector3d(0.16 * std::sin(stride_phase), left * kHipY_m, kAnkleZ_m + lift);
  const Vector3d front = X_TH.linear() * Vector3d::UnitX();
  const TwoBones leg = reach_with_two_bones(hip, ankle, kThigh_m, kShin_m, front);
  X_TP.push_back(bone_pose(hip, leg.middle, front));
  X_TP.push_back(bone_pose(leg.middle, leg.end, front));
  X_TP.push_back(Eigen::Translation3d(leg.end) * Pose(X_TH.linear()));
}

}  // namespace

std::vector<Pose> person_kinematics(const PersonMotion& motion) {
  // It faces the arm, against T's x.
  const Pose X_TH = translation(motion.x_T_m, 0.02, kFloorZ_m) * rotation(pi, Vector3d::UnitZ());
  const Pose X_TK =
      X_TH * translation(0, 0, kHipsZ_m) * rotation(motion.lean_rad, Vector3d::UnitY());
  const double phase = 2 * pi * motion.walked_m / 1.1;
  std::vector<Pose> X_TP{X_TK, X_TK * translation(0.025, 0, 0.745) *
                                   rotation(0.2 - motion.lean_rad, Vector3d::UnitY())};
  for (const double left : {1.0, -1.0}) {
    const Vector3d shoulder = X_TK * Vector3d(0, left * kShoulderY_m, 0.465);
    const double swing = -0.12 * left * std::sin(phase);
    const Vector3d hanging = shoulder + X_TH.linear() * Vector3d(0.08 + swing, 0.07 * left, -0.54);
    const double reach = left > 0 ? motion.reach : 0;
    place_arm(X_TP, X_TH, shoulder, hanging + reach * (motion.reached_wrist_T_m - hanging), left);
  }
  for (const double left : {1.0, -1.0}) place_leg(X_TP, X_TH, left, phase + (left > 0 ? 0 : pi));
  return X_TP;
}

}  // namespace berth::sim
