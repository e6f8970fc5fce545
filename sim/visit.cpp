#include "sim/visit.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "sim/person.hpp"
#include "sim/random.hpp"
#include "sim/room.hpp"
#include "sim/shapes.hpp"

namespace berth::sim {
namespace {

/// Out of sight of cameras and scanners: so far beyond where an Encounter begins.
constexpr double kLead_m = 2.0;
constexpr double kBox_m = 0.4;
/// From the base, where things come in.
constexpr double kFar_m = 2.4;

Eigen::AngleAxisd turn(double rad) { return {rad, Eigen::Vector3d::UnitZ()}; }

void move_all(const Pose& X, std::vector<Pose>& all) {
  for (Pose& one : all) one = X * one;
}

}  // namespace

std::vector<Pose> nowhere(std::size_t meshes) {
  Pose X = Pose::Identity();
  X.translation() = Eigen::Vector3d(100, 100, -100);
  return std::vector<Pose>(meshes, X);
}

Visit::Visit(VisitKind kind, std::uint32_t seed, std::span<const Bvh> motions)
    : kind_(kind),
      person_(seed, kind == VisitKind::hands ? Reach::to_table : Reach::to_arm),
      second_(seed + 1000003) {
  Random random(seed + 77);
  const bool is_beside = kind == VisitKind::beside;
  range_m_ = is_beside ? random(1.5, 2.0) : random(1.1, 1.6);
  speed_m_s_ = random(0.8, 1.6);
  duration_s_ = person_.duration_s();
  if (kind == VisitKind::two) duration_s_ = std::max(duration_s_, second_.duration_s());
  if (kind == VisitKind::passing) duration_s_ = 2 * kFar_m / speed_m_s_;
  if (kind != VisitKind::bvh) return;
  if (motions.empty()) throw std::invalid_argument("people: bvh; expected motions with it");
  measured_.emplace(motions, seed);
  duration_s_ = measured_->duration_s();
}

double Visit::lead_s() const {
  return kLead_m / (measured_ ? measured_->speed_m_s() : person_.speed_m_s());
}

std::vector<TriangleMesh> Visit::meshes() const {
  if (measured_) return measured_->meshes();
  if (kind_ == VisitKind::box) return {make_cuboid(Eigen::Vector3d::Constant(kBox_m))};
  std::vector<TriangleMesh> all = make_person_meshes();
  if (kind_ != VisitKind::two) return all;
  for (TriangleMesh& part : make_person_meshes()) all.push_back(std::move(part));
  return all;
}

std::vector<Pose> Visit::pose_at(double time_s) const {
  switch (kind_) {
    case VisitKind::beside:
      return beside_at(time_s);
    case VisitKind::passing:
      return passing_at(time_s);
    case VisitKind::crouching:
      return crouching_at(time_s);
    case VisitKind::box:
      return box_at(time_s);
    case VisitKind::two: {
      std::vector<Pose> all = person_at(person_, time_s);
      for (const Pose& X : person_at(second_, time_s)) all.push_back(X);
      return all;
    }
    case VisitKind::bvh:
      return measured_->pose_at(time_s);
    case VisitKind::reaching:
    case VisitKind::hands:
      break;
  }
  return person_at(person_, time_s);
}

std::vector<Pose> Visit::person_at(const Encounter& person, double time_s) const {
  const double within_s = std::clamp(time_s, 0.0, person.duration_s());
  std::vector<Pose> X_BP = person.pose_at(within_s);
  const double away_m = std::abs(time_s - within_s) * person.speed_m_s();
  const double side_rad = person.direction_rad();
  move_all(translation(away_m * std::cos(side_rad), away_m * std::sin(side_rad), 0), X_BP);
  return X_BP;
}

std::vector<Pose> Visit::beside_at(double time_s) const {
  PersonMotion motion;
  motion.x_T_m = range_m_;
  motion.walked_m = 0;
  motion.lean_rad = 0.1;
  // To and fro between two boxes, at half of a person's speed.
  motion.reach = 0.5 - 0.5 * std::cos(1.3 * time_s);
  motion.reached_wrist_T_m = {range_m_ - 0.45, 0.3, 0.3};
  std::vector<Pose> X_BP = person_kinematics(motion);
  const double away_s = std::max({0.0, -time_s, time_s - duration_s_});
  move_all(turn(person_.direction_rad()) * translation(speed_m_s_ * away_s, 0, 0), X_BP);
  return X_BP;
}

std::vector<Pose> Visit::passing_at(double time_s) const {
  PersonMotion motion;
  motion.x_T_m = range_m_;
  motion.walked_m = 0.5 * speed_m_s_ * time_s;
  motion.lean_rad = 0;
  motion.reach = 0;
  std::vector<Pose> X_BP = person_kinematics(motion);
  move_all(turn(person_.direction_rad()) * translation(0, kFar_m - speed_m_s_ * time_s, 0), X_BP);
  return X_BP;
}

std::vector<Pose> Visit::crouching_at(double time_s) const {
  constexpr double kDown_m = 0.55;
  const double share = time_s / duration_s_;
  const double near = smooth_step(0, 0.35, share) - smooth_step(0.65, 1, share);
  const double away_s = std::max({0.0, -time_s, time_s - duration_s_});
  PersonMotion motion;
  motion.x_T_m = 2.2 + (range_m_ - 2.2) * near + speed_m_s_ * away_s;
  motion.walked_m = (2.2 - range_m_) * near;
  motion.lean_rad = 0.5 * near;
  motion.reach = 0;
  std::vector<Pose> X_BP = person_kinematics(motion);
  const double down_m = kDown_m * (smooth_step(0.3, 0.45, share) - smooth_step(0.55, 0.7, share));
  move_all(turn(person_.direction_rad()) * translation(0, 0, -down_m), X_BP);
  return X_BP;
}

std::vector<Pose> Visit::box_at(double time_s) const {
  const double slid_m = std::clamp(1.6 * time_s, -kLead_m, kFar_m - range_m_);
  return {turn(person_.direction_rad()) *
          translation(kFar_m - slid_m, 0, kFloorZ_m + 0.9 + kBox_m / 2)};
}

}  // namespace berth::sim
