#pragma once

#include <optional>

#include "berth/pipeline/frame.hpp"
#include "berth/robot/joints_at_time.hpp"
#include "berth/types/setting.hpp"
#include "berth/types/status.hpp"

namespace berth {

/// From one frame's stamp to the next. If they are farther apart, one of the two may be wrong.
inline constexpr double kMostFrameGap_s = 1;
/// How far a frame's stamp may lie after the request, where the camera's clock goes ahead.
inline constexpr double kMostClockOffset_s = 0.005;

/// How old is too old. A result that is not in time has no distance (LinkStatus::stale): a
/// controller that forgets to look at ages must not take an old free space for a new one. To judge
/// an age yourself, set its limit to infinity and read Result::time.
struct TimeSettings {
  JointTimeLimits joints;
  /// From the exposure to the request. The default suits 30 Hz: time for the transfer, for the
  /// next frame, and for one that is lost.
  double max_frame_age_s = 0.15;
  /// From the joints' stamp to the request. Joints that a request names itself may lie ahead of it,
  /// where the robot is about to go; for a buffer's see kMostJointsAhead_s.
  double max_joints_age_s = 0.02;

  bool operator==(const TimeSettings&) const = default;
};

/// The list of these settings.
template <SettingsOf<TimeSettings> Settings, class Visitor>
void visit_settings(Settings& s, Visitor&& visit) {
  constexpr Domain kSeconds{.may_be_infinite = true};
  visit_settings(s.joints, visit);
  visit({"max_frame_age_s", kSeconds, "how old an image may be when it is asked"},
        s.max_frame_age_s);
  visit({"max_joints_age_s", kSeconds, "how old joints may be when they are asked about"},
        s.max_joints_age_s);
}

/// Throws std::invalid_argument with name, value and what was expected: a limit that is negative or
/// NaN.
void validate(const TimeSettings& settings);

/// The stamps of one camera's frames, each judged by the one before, whatever became of that: a
/// clock that was set costs one frame.
class FrameClock {
 public:
  /// ok, stamp_went_back (an image that comes a second time, too) or stamp_jumped.
  TimeStatus next(double stamp_s);

 private:
  std::optional<double> last_s_;
};

/// How a result stands at `now_s` for the joints of the exposure, whose age is the frame's.
/// Without now_s no age is known and none is judged. A frame that nobody has observed is no_frame.
Timeliness timeliness_of(const Exposure& frame, std::optional<double> now_s,
                         const TimeSettings& settings);

/// The same for joints of another stamp.
Timeliness timeliness_of(const Exposure& frame, double joints_stamp_s, std::optional<double> now_s,
                         const TimeSettings& settings);

/// What becomes of one camera at `now_s`, but for whether it is blind.
CameraState camera_state(const Exposure& exposure, double now_s, const TimeSettings& settings);

/// The same. `frame` is its newest one, or null where it has none yet.
CameraState camera_state(const Frame* frame, double now_s, const TimeSettings& settings);

}  // namespace berth
