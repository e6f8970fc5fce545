#include <fmt/format.h>

#include <cmath>

#include "berth/results/result_text.hpp"

namespace berth {
namespace {

/// " (0.42 s)" where a length of time is known.
std::string in_brackets(double seconds) {
  return std::isnan(seconds) ? std::string() : fmt::format(" ({:.2f} s)", seconds);
}

std::string stale_text(const Timeliness& time) {
  switch (time.status) {
    case TimeStatus::ok:
      return "";
    case TimeStatus::no_joints:
      return "no complete joint state has come yet";
    case TimeStatus::missing_joint:
      return "the newest joint states lack a joint of the robot";
    case TimeStatus::extrapolated_too_far:
      return "the exposure lies outside of the joint states" + in_brackets(time.skew_s);
    case TimeStatus::skewed:
      return "no joint state lies near enough to the exposure" + in_brackets(time.skew_s);
    case TimeStatus::stamp_went_back:
      return "an image's stamp is not above that of the one before";
    case TimeStatus::stamp_jumped:
      return "an image's stamp is too far above that of the one before";
    case TimeStatus::frame_in_future:
      return fmt::format("an image's stamp lies {:.3f} s in the future", -time.frame_age_s);
    case TimeStatus::stale_frame:
      return fmt::format("the newest image is {:.3f} s old", time.frame_age_s);
    case TimeStatus::stale_joints:
      if (time.joints_age_s < 0) {
        return fmt::format("the joint states lie {:.3f} s in the future", -time.joints_age_s);
      }
      return fmt::format("the joint states are {:.3f} s old", time.joints_age_s);
    case TimeStatus::no_frame:
      return "no camera has given an image yet";
    case TimeStatus::camera_moved:
      return "no camera stands where it should";
    case TimeStatus::camera_implausible:
      return "the robot is not where it should be in the images";
    case TimeStatus::stale_pose:
      return "nobody tells where the camera stood at the exposure";
  }
  return "";
}

}  // namespace

std::string camera_text(const CameraResult& camera) {
  if (is_relied_on(camera.status)) return "";
  std::string text = fmt::format("camera {} is {}", camera.camera, name_of(camera.status));
  if (camera.status == CameraStatus::too_old) return text + in_brackets(camera.age_s);
  if (camera.status == CameraStatus::stale) text += fmt::format(" ({})", name_of(camera.time));
  return text;
}

std::string status_text(const Result& result) {
  std::string text(name_of(result.status));
  if (result.status == ResultStatus::stale) return text + ": " + stale_text(result.time);
  const char* before = ": ";
  for (const CameraResult& camera : result.cameras) {
    const std::string lost = camera_text(camera);
    if (lost.empty()) continue;
    text += before + lost;
    before = ", ";
  }
  return text;
}

}  // namespace berth
