// Somebody who walks up to the arm, reaches in, and goes away again.
#pragma once

#include <cstdint>
#include <vector>

#include "berth/robot/triangle_mesh.hpp"
#include "berth/types/camera.hpp"

namespace berth::lab {

/// The parts of a person, each in its own frame.
std::vector<TriangleMesh> person_parts();

/// A drawn way of a person. Depends on its seed alone.
class Encounter {
 public:
  explicit Encounter(std::uint32_t seed);

  /// The poses of person_parts(); nobody is in sight at 0 and at duration_s().
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
  /// Of the fastest point of the body, in each of equal steps.
  std::vector<double> ways() const;

  double direction_rad_;
  double nearest_m_;
  Eigen::Vector3d wrist_m_;
  double speed_m_s_;
  double first_phase_;
  /// The time that a step in takes.
  double unit_s_ = 1;
};

}  // namespace berth::lab
