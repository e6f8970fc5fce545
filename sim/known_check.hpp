// Whether an arm met its table, its floor or itself.
#pragma once

#include <limits>
#include <vector>

#include "berth/robot/kinematics.hpp"
#include "berth/separation/link_speed.hpp"
#include "sim/mesh_distance.hpp"

namespace berth::sim {

/// Mesh to mesh, by FCL: each link that a joint moves against all other links but its neighbours,
/// and but those that it touches in each of some drawn poses.
class KnownCheck {
 public:
  explicit KnownCheck(const RobotModel& model);

  /// Of an arm that moves.
  void add(const RobotPose& pose, double fastest_m_s);

  /// To 2 mm above what it was; infinite where the arm never moved.
  double least_m() const { return least_m_; }
  /// Of the arm's fastest point where something met; 0 where nothing did.
  double contact_m_s() const { return contact_m_s_; }

 private:
  /// What was measured last, and where the link stood to the other one then.
  struct Pair {
    std::size_t link;
    std::size_t other;
    double distance_m = 0;
    Pose X_OL = Pose::Identity();
  };
  double measure(const Pair& pair, const RobotPose& pose) const;
  bool always_touches(const RobotModel& model, const Pair& pair) const;

  std::vector<MeshTree> trees_;
  std::vector<HullPoints> hulls_;
  std::vector<Pair> pairs_;
  double least_m_ = std::numeric_limits<double>::infinity();
  double contact_m_s_ = 0;
};

}  // namespace berth::sim
