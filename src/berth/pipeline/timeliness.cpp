#include "berth/pipeline/timeliness.hpp"

#include <cmath>
#include <utility>

namespace berth {

void validate(const TimeSettings& settings) { visit_settings(settings, SettingCheck{"time"}); }

TimeStatus FrameClock::next(double stamp_s) {
  // A stamp that is no time says nothing about the next one.
  if (!std::isfinite(stamp_s)) return TimeStatus::stamp_jumped;
  const std::optional<double> last_s = std::exchange(last_s_, stamp_s);
  if (!last_s) return TimeStatus::ok;
  if (stamp_s <= *last_s) return TimeStatus::stamp_went_back;
  return stamp_s - *last_s <= kMostFrameGap_s ? TimeStatus::ok : TimeStatus::stamp_jumped;
}

Timeliness timeliness_of(const Exposure& frame, std::optional<double> now_s,
                         const TimeSettings& settings) {
  Timeliness time;
  if (!frame.mounted) {
    time.status = TimeStatus::no_frame;
    return time;
  }
  time.status = frame.time.status;
  time.skew_s = frame.time.skew_s;
  if (time.status == TimeStatus::ok && !frame.watch.is_trusted()) {
    time.status =
        frame.watch.is_implausible ? TimeStatus::camera_implausible : TimeStatus::camera_moved;
  }
  if (!now_s) return time;
  time.frame_age_s = time.joints_age_s = *now_s - frame.stamp_s;
  if (time.status != TimeStatus::ok) return time;
  if (time.frame_age_s < -kMostClockOffset_s) {
    time.status = TimeStatus::frame_in_future;
  } else if (!(time.frame_age_s <= settings.max_frame_age_s)) {
    // So is an age that is NaN.
    time.status = TimeStatus::stale_frame;
  }
  return time;
}

Timeliness timeliness_of(const Exposure& frame, double joints_stamp_s, std::optional<double> now_s,
                         const TimeSettings& settings) {
  Timeliness time = timeliness_of(frame, now_s, settings);
  if (!now_s) return time;
  time.joints_age_s = *now_s - joints_stamp_s;
  const bool fresh = time.joints_age_s <= settings.max_joints_age_s;
  if (time.status == TimeStatus::ok && !fresh) time.status = TimeStatus::stale_joints;
  return time;
}

CameraState camera_state(const Exposure& exposure, double now_s, const TimeSettings& settings) {
  CameraState state;
  if (!exposure.mounted) return state;
  state.stamp_s = exposure.stamp_s;
  state.age_s = now_s - exposure.stamp_s;
  state.time = exposure.time.status;
  state.watch = exposure.watch;
  if (state.time == TimeStatus::stale_pose) {
    state.status = CameraStatus::stale_pose;
  } else if (state.time != TimeStatus::ok) {
    state.status = CameraStatus::stale;
  } else if (exposure.watch.is_implausible) {
    state.status = CameraStatus::implausible;
    state.time = TimeStatus::camera_implausible;
  } else if (exposure.watch.has_moved) {
    state.status = CameraStatus::moved;
    state.time = TimeStatus::camera_moved;
  } else if (state.age_s < -kMostClockOffset_s) {
    state.status = CameraStatus::stale;
    state.time = TimeStatus::frame_in_future;
  } else if (!(state.age_s <= settings.max_frame_age_s)) {
    state.status = CameraStatus::too_old;
  } else {
    state.status = exposure.watch.is_hidden        ? CameraStatus::hidden
                   : exposure.watch.is_unconfirmed ? CameraStatus::unconfirmed
                                                   : CameraStatus::ok;
  }
  return state;
}

CameraState camera_state(const Frame* frame, double now_s, const TimeSettings& settings) {
  if (!frame) return {};
  CameraState state = camera_state(*frame, now_s, settings);
  if (is_used(state.status) && frame->is_blind) state.status = CameraStatus::blind;
  return state;
}

}  // namespace berth
