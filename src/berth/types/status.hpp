#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <string_view>

namespace berth {

/// Whether stamps and joints, and the camera, allow an answer. What is not ok gives none: see
/// Timeliness.
enum class TimeStatus : std::uint8_t {
  ok,
  no_joints,             ///< nobody has given a joint sample yet
  missing_joint,         ///< the newest joint sample lacked one of the robot's joints
  extrapolated_too_far,  ///< the exposure lies outside of the joint samples by more than the limit
  skewed,                ///< no joint sample lies near enough to the exposure
  stamp_went_back,       ///< the frame's stamp is not above that of the frame before
  stamp_jumped,     ///< the frame's stamp is too far above that of the frame before, or not finite
  frame_in_future,  ///< the frame's stamp lies after the time of the request
  stale_frame,      ///< the frame is too old
  stale_joints,     ///< the joints are too old
  no_frame,         ///< no camera has given a frame yet
  camera_moved,     ///< the camera does not stand where it should (CameraStatus::moved)
  camera_implausible,  ///< the robot is not where it should be (CameraStatus::implausible)
  stale_pose,          ///< nobody knows where the camera stood at the exposure
};
inline constexpr int kTimeStatusCount = 14;  ///< of them
/// By enumerator.
inline constexpr std::array<std::string_view, kTimeStatusCount> kTimeStatusNames = {
    "ok",
    "no_joints",
    "missing_joint",
    "extrapolated_too_far",
    "skewed",
    "stamp_went_back",
    "stamp_jumped",
    "frame_in_future",
    "stale_frame",
    "stale_joints",
    "no_frame",
    "camera_moved",
    "camera_implausible",
    "stale_pose"};

constexpr std::string_view name_of(TimeStatus status) {
  return kTimeStatusNames[static_cast<std::size_t>(status)];
}

/// A frame's time as it is known before any request.
struct FrameTime {
  TimeStatus status = TimeStatus::ok;
  /// From the exposure to the nearest joint sample; NaN where there is none.
  double skew_s = 0;
};

/// How an answer stands in time. Unless status is ok, the answer has no distance. An age is that at
/// the request; NaN where nobody told the time of the request.
struct Timeliness {
  TimeStatus status = TimeStatus::ok;
  double frame_age_s = std::numeric_limits<double>::quiet_NaN();
  double joints_age_s = std::numeric_limits<double>::quiet_NaN();
  double skew_s = std::numeric_limits<double>::quiet_NaN();
};

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

/// What is known of a link.
enum class LinkStatus : std::uint8_t {
  ok,             ///< there is a distance
  none_in_range,  ///< the link is seen, and nothing is within the range
  not_visible,    ///< the thesis: the camera sees no pixel of the link, so nothing is known
  cut_short,      ///< the search was stopped before it found a pair within the range
  stale,          ///< stamps or ages allow no answer (Result::time): nothing is known
  not_seen,       ///< hardly anything of the link is seen by any camera. What is known
                  ///< to be near stands beside it, but nothing is promised
  not_observed,   ///< too much of the space within its distance, or the range, lies in
                  ///< no image. What is known to be near stands beside it, but nothing is promised
};
/// By enumerator.
inline constexpr std::array<std::string_view, 7> kLinkStatusNames = {
    "ok", "none_in_range", "not_visible", "cut_short", "stale", "not_seen", "not_observed"};

constexpr std::string_view name_of(LinkStatus status) {
  return kLinkStatusNames[static_cast<std::size_t>(status)];
}

/// How good a whole result is.
enum class ResultStatus : std::uint8_t {
  ok,        ///< every camera is in it
  degraded,  ///< a camera is not in it, or not relied on: distances may be larger than with it
  stale,     ///< stamps, ages or a camera allow no answer: no link has a distance
};
/// By enumerator.
inline constexpr std::array<std::string_view, 3> kResultStatusNames = {"ok", "degraded", "stale"};

constexpr std::string_view name_of(ResultStatus status) {
  return kResultStatusNames[static_cast<std::size_t>(status)];
}

}  // namespace berth
