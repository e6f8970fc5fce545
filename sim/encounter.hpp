// Somebody who walks up to the arm, reaches in, and goes away again.
#pragma once

#include <cstdint>
#include <vector>

#include "berth/types/camera.hpp"

namespace berth::sim {

/// Where the hand goes.
enum class Reach {
  to_arm,    ///< anywhere before the arm
  to_table,  ///< onto the table's top, where the arm takes and puts things
};

/// How a drawn person comes and goes. Depends on its arguments alone.
class Encounter {
 public:
  explicit Encounter(std::uint32_t seed, Reach reach = Reach::to_arm);

  /// The poses of make_person_meshes(); nobody is in sight at 0 and at duration_s().
  std::vector<Pose> pose_at(double time_s) const;
  double duration_s() const { return kUnits * unit_s_; }
  /// Of the fastest part of the body, at most 1.6 m/s.
  double speed_m_s() const { return speed_m_s_; }
  /// From which side, about the base's z; rad.
  double direction_rad() const { return direction_rad_; }
  /// Where on its path the arm begins, of a cycle.
  double first_phase() const { return first_phase_; }

 private:
  static constexpr double kUnits = 3.1;
  std::vector<Pose> pose_in_units(double units) const;
  /// How far the body's fastest point gets in each of equal times.
  std::vector<double> greatest_steps_m() const;

  double direction_rad_;
  double nearest_m_;
  /// All of the way is moved by this towards the base.
  double nearer_m_ = 0;
  Eigen::Vector3d wrist_m_;
  double speed_m_s_;
  double first_phase_;
  /// The time that a step in takes.
  double unit_s_ = 1;
};

}  // namespace berth::sim
