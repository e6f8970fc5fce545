#pragma once

#include <limits>
#include <span>
#include <vector>

#include "berth/types/joint_state.hpp"
#include "berth/types/setting.hpp"
#include "berth/types/status.hpp"

namespace berth {

struct JointTimeLimits {
  /// From the time asked for to the nearest sample: farther away, a straight line between two
  /// samples is a guess.
  double max_skew_s = 0.02;
  /// Beyond the first or the last sample. No setting: no recording gained by more.
  double max_extrapolation_s = 0;

  bool operator==(const JointTimeLimits&) const = default;
};

/// The list of these settings.
template <SettingsOf<JointTimeLimits> Settings, class Visitor>
void visit_settings(Settings& s, Visitor&& visit) {
  constexpr Domain kSeconds{.may_be_infinite = true};
  visit({"max_skew_s", kSeconds, "how far the nearest sample of the joints may lie from an image"},
        s.max_skew_s);
}

/// No limit but that nothing is extrapolated.
inline constexpr JointTimeLimits kOnlyBetweenSamples{std::numeric_limits<double>::infinity(), 0};

/// For recordings: farther from a sample a robot that moves may be anywhere.
inline constexpr JointTimeLimits kInRecordings{0.1, 0};

/// One joint on the line between two positions: `share` is 0 at `before`, 1 at `after`. A
/// continuous joint takes the shorter way round.
double joint_between(double before, double after, double share, bool is_continuous);

/// The joints at `time_s`: linear between the two samples around it or, within the limit, beyond
/// the two at the end (one sample alone is held); a continuous joint takes the shorter way round.
/// `samples` have increasing stamps. Where the status is not ok, all of `joints` is NaN, as many as
/// is_continuous. Reuses the memory of `joints`.
FrameTime joints_at_time(std::span<const JointState> samples,
                         const std::vector<bool>& is_continuous, double time_s,
                         const JointTimeLimits& limits, JointState& joints);

}  // namespace berth
