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
inline constexpr int kTimeStatusCount = 14;
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

}  // namespace berth
