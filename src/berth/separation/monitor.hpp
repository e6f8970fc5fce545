#pragma once

#include <limits>
#include <memory>
#include <span>

#include "berth/pipeline/result.hpp"
#include "berth/pipeline/robot.hpp"
#include "berth/separation/planned_motion.hpp"
#include "berth/separation/settings.hpp"
#include "berth/types/separation.hpp"

namespace berth {

class FrameSet;

/// What a SeparationMonitor keeps from one update to the next.
struct SeparationMemory {
  /// Nothing was updated yet.
  bool is_first = true;
  /// The scale of the update before, and when that was.
  double scale = 0;
  double last_s = -std::numeric_limits<double>::infinity();
  /// The place of the link that kept the robot from going faster on its way; -1: none.
  int critical_link = -1;
};

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

  /// Valid until the next update. Joint velocities that are missing or not finite stop the robot.
  /// `now_s` is on the clock of the stamps. `frames` are those that the result is about
  /// (Query::frames()): with them the scale is shown along the robot's way until it stands; null:
  /// by the protective separation distance alone, as if it ran straight at what is nearest.
  /// The scale falls at once. It rises as fast as the motors let the robot gain speed: what is
  /// checked is the stop from the new speed, so that nothing is gained by waiting.
  const Separation& update(const Result& result, const PlannedMotion& motion, double now_s,
                           const FrameSet* frames = nullptr);

  const SeparationSettings& settings() const;
  /// With what another monitor of this robot remembers, the next update is that of the other one.
  SeparationMemory memory() const;
  void recall(const SeparationMemory& memory);

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace berth
