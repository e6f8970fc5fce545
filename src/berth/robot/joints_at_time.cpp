#include "berth/robot/joints_at_time.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace berth {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

/// On the line through both; `share` is 0 at `before`, 1 at `after`.
void follow_line(const JointState& before, const JointState& after, double share,
                 const std::vector<bool>& is_continuous, JointState& joints) {
  for (std::size_t i = 0; i < before.position.size(); ++i) {
    joints.position[i] =
        joint_between(before.position[i], after.position[i], share, is_continuous[i]);
  }
}

FrameTime time_of(std::span<const JointState> samples, double time_s,
                  std::span<const JointState>::iterator after, const JointTimeLimits& limits) {
  if (samples.empty()) return {TimeStatus::no_joints, kNaN};
  const double to_first_s = samples.front().stamp_s - time_s;
  const double from_last_s = time_s - samples.back().stamp_s;
  const double outside_s = std::max(to_first_s, from_last_s);
  double skew_s = outside_s;
  if (outside_s <= 0) {
    skew_s = after->stamp_s - time_s;
    if (after != samples.begin()) skew_s = std::min(skew_s, time_s - (after - 1)->stamp_s);
  }
  // A time that is NaN is within no limit.
  if (!(outside_s <= limits.max_extrapolation_s)) {
    return {TimeStatus::extrapolated_too_far, skew_s};
  }
  return {skew_s <= limits.max_skew_s ? TimeStatus::ok : TimeStatus::skewed, skew_s};
}

}  // namespace

double joint_between(double before, double after, double share, bool is_continuous) {
  double step = after - before;
  if (is_continuous) step = std::remainder(step, 2 * std::numbers::pi);
  return before + share * step;
}

FrameTime joints_at_time(std::span<const JointState> samples,
                         const std::vector<bool>& is_continuous, double time_s,
                         const JointTimeLimits& limits, JointState& joints) {
  joints.stamp_s = time_s;
  joints.position.assign(is_continuous.size(), kNaN);
  const auto after =
      std::lower_bound(samples.begin(), samples.end(), time_s,
                       [](const JointState& state, double t) { return state.stamp_s < t; });
  const FrameTime time = time_of(samples, time_s, after, limits);
  if (time.status != TimeStatus::ok) return time;
  if (samples.size() == 1 || (after != samples.end() && after->stamp_s == time_s)) {
    joints.position = samples.size() == 1 ? samples.front().position : after->position;
    return time;
  }
  const auto last = std::clamp(after, samples.begin() + 1, samples.end() - 1);
  const auto first = last - 1;
  follow_line(*first, *last, (time_s - first->stamp_s) / (last->stamp_s - first->stamp_s),
              is_continuous, joints);
  return time;
}

}  // namespace berth
