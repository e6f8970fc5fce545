#include "berth/separation/detection.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "berth/separation/protective_distance.hpp"

namespace berth {
namespace {

double told_m(const MountedCamera& camera) {
  return detection_capability_m(camera.settings().space, camera.camera());
}

}  // namespace

double least_detection_m(std::span<const CameraResult> cameras) {
  double least_m = 0;
  for (const CameraResult& camera : cameras) {
    if (!camera.mounted || !is_used(camera.status)) continue;
    least_m = std::max(least_m, told_m(*camera.mounted));
  }
  return least_m;
}

std::string detection_trouble(const SeparationSettings& settings, const MountedCamera& camera) {
  if (settings.intrusion_m || !settings.detection_m) return {};
  const double least_m = told_m(camera);
  if (least_m <= *settings.detection_m) return {};
  return fmt::format(
      "separation.detection_m: {}; expected at least space.detection_capability_m of camera "
      "\"{}\", {}: what is smaller may hide from it. C is {:.3f} m",
      *settings.detection_m, camera.mount().name, least_m, intrusion_m(settings, least_m));
}

}  // namespace berth
