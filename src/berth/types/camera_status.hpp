#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <string_view>

#include "berth/types/camera_watch.hpp"
#include "berth/types/time_status.hpp"

namespace berth {

/// What became of one camera in a question.
enum class CameraStatus : std::uint8_t {
  ok,        ///< its frame is used
  no_frame,  ///< it has given none yet
  untimely,  ///< stamps or joints of its frame are wrong (FrameTime says how): not used
  too_old,   ///< its frame is older than TimeSettings::max_frame_age_s: not used
  blind,     ///< hardly a pixel has a reading: those there are count, but nothing is seen free
  moved,     ///< it does not stand where it should (PoseWatch): not used
  /// the robot is not where it should be in its images (WatchSettings::min_at_robot): not used
  implausible,
  hidden,  ///< the robot is hidden, so that nothing tells whether it is where it should be: used
};
/// By enumerator.
inline constexpr std::array<std::string_view, 8> kCameraStatusNames = {
    "ok", "no_frame", "untimely", "too_old", "blind", "moved", "implausible", "hidden"};

constexpr std::string_view name_of(CameraStatus status) {
  return kCameraStatusNames[static_cast<std::size_t>(status)];
}

/// Whether the readings of its frame count.
constexpr bool is_used(CameraStatus status) {
  return status == CameraStatus::ok || status == CameraStatus::blind ||
         status == CameraStatus::hidden;
}

/// One camera's part in an answer.
struct CameraState {
  CameraStatus status = CameraStatus::no_frame;
  /// Of its frame; NaN where there is none.
  double stamp_s = std::numeric_limits<double>::quiet_NaN();
  /// Of its frame, at the question or, where nobody told its time, at the newest frame.
  double age_s = std::numeric_limits<double>::quiet_NaN();
  /// Why it is untimely.
  TimeStatus time = TimeStatus::ok;
  /// Of its frame.
  CameraWatch watch = {};
};

}  // namespace berth
