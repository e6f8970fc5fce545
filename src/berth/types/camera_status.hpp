#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <string_view>

#include "berth/types/time_status.hpp"

namespace berth {

/// Whether a camera stands where it should, as far as that is known (PoseWatch).
struct CameraWatch {
  /// Whether anybody looks whether it was bumped.
  bool is_on = false;
  /// It does not: its frames are not used.
  bool has_moved = false;
  /// The robot is not where it should be in its images, from the first one on or since some of
  /// them: something that it is told by is wrong. Its frames are not used.
  bool is_implausible = false;
  /// The same where it is only told (WatchSettings::tell_only): its frames are used.
  bool is_unconfirmed = false;
  /// Something stands before so much of the robot that the frame does not tell whether the rest is
  /// where it should be. No mistake: the frame is used.
  bool is_hidden = false;
  /// T, the share of the robot's readings in the frame that lie behind the robot's surface; NaN
  /// where too little of the robot is seen.
  double seen_through = std::numeric_limits<double>::quiet_NaN();
  /// D, by how much the robot has to be moved to fit an image, as it was measured last: in this
  /// frame or one before; NaN until it was.
  double displacement_m = std::numeric_limits<double>::quiet_NaN();
  /// The share of the robot's readings that lie at its surface, hidden ones left out; NaN where too
  /// little of the robot is seen, or nobody looks.
  double at_robot = std::numeric_limits<double>::quiet_NaN();

  bool is_trusted() const { return !has_moved && !is_implausible; }
};

/// What became of one camera in a request.
enum class CameraStatus : std::uint8_t {
  ok,        ///< its frame is used
  no_frame,  ///< it has given none yet
  stale,     ///< stamps or joints of its frame are wrong (FrameTime says how): not used
  too_old,   ///< its frame is older than TimeSettings::max_frame_age_s: not used
  blind,     ///< hardly a pixel has a reading: those there are count, but nothing is seen free
  moved,     ///< it does not stand where it should (PoseWatch): not used
  /// the robot is not where it should be in its images (WatchSettings::min_at_robot): not used
  implausible,
  hidden,  ///< the robot is hidden, so that nothing tells whether it is where it should be: used
  /// the robot is not where it should be in its images, and nobody asked for that to be refused
  /// (WatchSettings::tell_only): used
  unconfirmed,
  stale_pose,  ///< nobody knows where it stood at the exposure: not used
};
/// By enumerator.
inline constexpr std::array<std::string_view, 10> kCameraStatusNames = {
    "ok",    "no_frame",    "stale",  "too_old",     "blind",
    "moved", "implausible", "hidden", "unconfirmed", "stale_pose"};

constexpr std::string_view name_of(CameraStatus status) {
  return kCameraStatusNames[static_cast<std::size_t>(status)];
}

/// Whether the readings of its frame count.
constexpr bool is_used(CameraStatus status) {
  return status == CameraStatus::ok || status == CameraStatus::blind ||
         status == CameraStatus::hidden || status == CameraStatus::unconfirmed;
}

/// Whether its images can be relied on for space that they see free.
constexpr bool is_relied_on(CameraStatus status) {
  return status == CameraStatus::ok || status == CameraStatus::hidden;
}

/// One camera's part in a result.
struct CameraState {
  CameraStatus status = CameraStatus::no_frame;
  /// Of its frame; NaN where there is none.
  double stamp_s = std::numeric_limits<double>::quiet_NaN();
  /// Of its frame, at the request or, where nobody told its time, at the newest frame.
  double age_s = std::numeric_limits<double>::quiet_NaN();
  /// Why it is stale.
  TimeStatus time = TimeStatus::ok;
  /// Of its frame.
  CameraWatch watch = {};
};

}  // namespace berth
