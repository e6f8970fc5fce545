#pragma once

#include <memory>
#include <span>

#include "berth/pipeline/result.hpp"
#include "berth/pipeline/robot.hpp"
#include "berth/separation/settings.hpp"
#include "berth/types/separation.hpp"

namespace berth {

/// Speed and separation monitoring: after each result, how fast the robot may go on (ISO/TS 15066,
/// 5.5.4). **Not a certified safety function.** One for each thread; once made, nothing allocates.
///
/// For each link that a joint moves, everything has to be as far away as the protective separation
/// distance S. The certified lower bound of the result says how near something may be; what is not
/// known counts as near, by the policies of the settings.
class SeparationMonitor {
 public:
  /// Throws std::invalid_argument that names the setting, its value and what was expected; also
  /// where the robot's results do not tell what is seen (EvaluationSettings::visibility).
  SeparationMonitor(std::shared_ptr<const Robot> robot, SeparationSettings settings);
  ~SeparationMonitor();
  SeparationMonitor(SeparationMonitor&&) noexcept;
  SeparationMonitor& operator=(SeparationMonitor&&) noexcept;

  /// Valid until the next update. `velocity` are the joints' velocities (rad/s or m/s) at the
  /// joints that the result is about: as measured, or those that the program wants, if it obeys the
  /// scale. One that is missing or not finite stops the robot. `now_s` is on the clock of the
  /// stamps. Until it has had room for SeparationSettings::hold_s, the robot is stopped.
  const Separation& update(const Result& result, std::span<const double> velocity, double now_s);

  const SeparationSettings& settings() const;

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace berth
