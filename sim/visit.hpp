// What comes near the arm: people of several kinds, and things.
#pragma once

#include <array>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "berth/robot/triangle_mesh.hpp"
#include "sim/encounter.hpp"
#include "sim/measured_person.hpp"

namespace berth::sim {

enum class VisitKind {
  reaching,   ///< somebody walks up, reaches in and goes away again: an Encounter
  beside,     ///< somebody works at a fixture 1.5 to 2 m from the base
  passing,    ///< somebody goes past, 1.1 to 1.6 m from the base
  two,        ///< two reach in from drawn sides
  crouching,  ///< somebody walks up, crouches behind the table, and rises again
  box,        ///< a box slides in, and stays
  hands,      ///< somebody reaches in and puts a hand on the table where the gripper goes
  bvh,        ///< a MeasuredPerson
};
inline constexpr std::array<std::string_view, 8> kVisitKindNames = {
    "reaching", "beside", "passing", "two", "crouching", "box", "hands", "bvh"};

/// Depends on its arguments alone. Nobody is faster than 1.6 m/s, but for a MeasuredPerson.
class Visit {
 public:
  /// `motions` outlive it; for VisitKind::bvh there is one at least.
  Visit(VisitKind kind, std::uint32_t seed, std::span<const Bvh> motions = {});

  /// What there is; each in its own frame.
  std::vector<TriangleMesh> meshes() const;
  /// Where each of them is. Before 0 people come from farther away, after duration_s() they go on;
  /// lead_s() before and after they are out of sight.
  std::vector<Pose> pose_at(double time_s) const;
  double duration_s() const { return duration_s_; }
  double lead_s() const;
  /// Where on its path the arm begins, of a cycle.
  double first_phase() const { return person_.first_phase(); }

 private:
  std::vector<Pose> person_at(const Encounter& person, double time_s) const;
  std::vector<Pose> beside_at(double time_s) const;
  std::vector<Pose> passing_at(double time_s) const;
  std::vector<Pose> crouching_at(double time_s) const;
  std::vector<Pose> box_at(double time_s) const;

  VisitKind kind_;
  Encounter person_;
  Encounter second_;
  std::optional<MeasuredPerson> measured_;
  /// Of what is no Encounter: how far from the base it is, and how fast.
  double range_m_;
  double speed_m_s_;
  double duration_s_;
};

/// The same number of meshes where nobody is.
std::vector<Pose> nowhere(std::size_t meshes);

}  // namespace berth::sim
