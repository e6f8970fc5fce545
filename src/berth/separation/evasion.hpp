// How the robot gives way to what comes near, in place of only stopping.
#pragma once

#include <memory>
#include <span>
#include <string>
#include <vector>

#include "berth/pipeline/result.hpp"
#include "berth/pipeline/robot.hpp"
#include "berth/robot/kinematics.hpp"
#include "berth/types/setting.hpp"

namespace berth {

/// The functions of the distance d are 1 / (1 + exp((2 d / reach_m - 1) steepness)): 1 where
/// something touches, one half at half the reach, 0 far away.
struct EvasionSettings {
  double reach_m = 0.6;
  double steepness = 6;
  /// Of the end effector, where something touches it.
  double max_speed_m_s = 0.6;
  /// Of the Jacobian's inverse, in m: keeps joint speeds small near singular poses.
  double damping_m = 0.1;
};

/// The list of these settings.
template <SettingsOf<EvasionSettings> Settings, class Visitor>
void visit_settings(Settings& s, Visitor&& visit) {
  visit({"reach_m", kAboveZero, "from here on the robot gives way"}, s.reach_m);
  visit({"steepness", kAboveZero, "how sudden it does"}, s.steepness);
  visit({"max_speed_m_s", kNotNegative, "how fast the end effector gives way"}, s.max_speed_m_s);
  visit({"damping_m", kAboveZero, "keeps joint speeds small near singular poses"}, s.damping_m);
}

/// What a controller does with a result. One number for each joint.
struct Evasion {
  /// Moves the end effector away from what is near it (rad/s or m/s); added to what the program
  /// plans.
  std::vector<double> velocity;
  /// The shares, 0 to 1, of the joint's greatest speeds that the body allows in the positive and in
  /// the negative direction; the sum of both velocities is clamped to them.
  std::vector<double> forward;
  std::vector<double> backward;
};

/// Repulsive vectors (Flacco, Kroeger, De Luca and Khatib 2012) from berth's results: the least
/// distance gives the length, the mean direction (Hirt 2.2.5) the direction, where it is asked for.
/// **It reacts to what is near and promises nothing**: not that there is room to give way, nor that
/// it is in time. One for each thread; once made, nothing allocates.
class Evader {
 public:
  /// `end_effector` is an evaluated link. Throws std::invalid_argument that names the setting or
  /// the link and what was expected.
  Evader(std::shared_ptr<const Robot> robot, const std::string& end_effector,
         const EvasionSettings& settings);

  /// Valid until the next update. Links whose distance is not known do not count.
  const Evasion& update(const Result& result);

 private:
  /// By how much something at this distance counts, 0 to 1.
  double risk(double distance_m) const;
  void give_way(const LinkResult& link);
  void hold_back(const LinkResult& link);

  std::shared_ptr<const Robot> robot_;
  EvasionSettings settings_;
  LinkId end_effector_ = kNoLink;
  Eigen::Matrix3Xd jacobian_;
  Evasion out_;
};

}  // namespace berth
