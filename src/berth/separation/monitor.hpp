#pragma once

#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "berth/pipeline/answer.hpp"
#include "berth/pipeline/robot.hpp"
#include "berth/separation/link_speed.hpp"
#include "berth/separation/protective_distance.hpp"
#include "berth/separation/separation.hpp"
#include "berth/separation/settings.hpp"
#include "berth/separation/speed_hold.hpp"
#include "berth/types/joint_state.hpp"

namespace berth {

/// An answer, and how the robot moves.
struct SeparationQuestion {
  const Answer& answer;
  /// Camera k's part in it, and its frame.
  std::span<const CameraState> cameras;
  std::span<const std::shared_ptr<const Frame>> frames;
  /// The joints that the answer is about, and their velocities (rad/s or m/s): as measured, or
  /// those that the program wants, if it obeys the scale.
  std::span<const double> position;
  std::span<const double> velocity;
  /// On the clock of the stamps.
  double now_s = 0;
};

/// Speed and separation monitoring: after each answer, how fast the robot may go on (ISO/TS 15066,
/// 5.5.4). **Not a certified safety function.** One for each thread; once made, nothing allocates.
///
/// For each link that a joint moves, everything has to be as far away as the protective separation
/// distance S. The certified lower bound of the answer says how near something may be; what is not
/// known counts as near, by the policies of the settings.
class SeparationMonitor {
 public:
  /// Throws std::invalid_argument that names the setting, its value and what was expected; also
  /// where the robot's answers do not tell what is seen (EvaluationSettings::visibility).
  SeparationMonitor(std::shared_ptr<const Robot> robot, SeparationSettings settings);

  /// Valid until the next question. A velocity or position that is missing or not finite stops the
  /// robot. Until it has had room for SeparationSettings::hold_s, the robot is stopped.
  const Separation& look(const SeparationQuestion& question);

  const SeparationSettings& settings() const { return settings_; }

 private:
  /// Where the question leaves nothing to compute, why.
  SeparationReason begin(const SeparationQuestion& question);
  void look_at_links(const SeparationQuestion& question);
  /// Sets that of each link; that of the robot's fastest point.
  double measure_speeds(const SeparationQuestion& question);
  /// Towards the closest obstacle, where that is what counts.
  std::optional<double> speed_towards(const SeparationQuestion& question, std::size_t i) const;
  void look_at(const SeparationQuestion& question, double robot_m_s, std::size_t i);
  double camera_uncertainty(const SeparationQuestion& question, std::size_t i) const;
  void decide(double now_s);

  std::shared_ptr<const Robot> robot_;
  SeparationSettings settings_;
  /// hulls_[i] is of the link with the id i + 1.
  std::vector<HullPoints> hulls_;
  RobotPose pose_;
  std::vector<double> position_;
  std::vector<LinkTwist> twists_;
  /// Of the link that has least room, with release_m to spare.
  double rising_scale_ = 0;
  SpeedHold hold_;
  Separation out_;
};

}  // namespace berth
