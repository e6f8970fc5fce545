// An arm with goals: it goes from station to station, and takes those that people leave free.
#pragma once

#include <vector>

#include "berth/control/velocity_filter.hpp"
#include "lab/closed_loop/supervisor.hpp"

namespace berth::lab {

/// Where the arm takes and puts things: over the work area of the other policies' path.
const std::vector<std::vector<double>>& stations_rad();

/// berth's monitor along the way to a station, and its filter.
///
/// Ways are straight in joint space, and a new one begins where the arm stands. So the arm stays on
/// the way that the monitor was told while it brakes. Where the filter leads it aside, and until
/// the arm goes straight again, the monitor goes by the formula, which holds in any direction.
class GoalSupervisor : public MonitorSupervisor {
 public:
  GoalSupervisor(std::vector<int> cameras, const SeparationSettings& settings, double request_hz);

  double scale(const Situation& situation) override;
  std::optional<std::vector<double>> velocity_rad_s() const override { return velocity_rad_s_; }
  Progress progress() const override;

 private:
  using Joints = std::vector<double>;

  /// Whether joints and images are there.
  bool begin(const Situation& situation);
  void choose(double now_s);
  /// How easily it goes to each station with the room that people leave, 0 to 1.
  void look_at_ways(double now_s);
  /// What is gained there, as a time at full speed, in each second.
  double worth(std::size_t station) const;
  std::size_t best_station() const;
  void find_wanted();
  void obey(double now_s);

  /// Beside the requests of the loop: of the ways to the stations.
  Query look_;
  VelocityFilter filter_;
  JointState now_;
  bool is_standing_ = true;
  /// The least of the links' distances.
  double near_m_ = 0;
  /// Of the stations.
  std::size_t goal_ = 0;
  /// Whether it is to stand, and to take up another way.
  bool changes_ = true;
  /// Where it began, or the station that it reached last.
  Joints from_rad_;
  /// Of its present way: the joint that goes farthest.
  double way_rad_ = 0;
  int reached_ = 0;
  double reached_s_ = 0;
  /// By station: after how many others it was reached last.
  std::vector<int> last_;
  std::vector<double> ease_;
  double looked_s_ = 0;
  double led_aside_s_;
  double scale_ = 0;
  Joints wanted_rad_s_;
  Joints velocity_rad_s_;
  std::vector<JointState> way_;
};

}  // namespace berth::lab
