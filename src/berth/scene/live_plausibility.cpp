#include "berth/scene/live_plausibility.hpp"

#include <tbb/task_arena.h>

#include <algorithm>
#include <cmath>

#include "berth/calibration/calibrate.hpp"
#include "berth/scene/scene_calibration.hpp"

namespace berth {
namespace {

OpenCamera camera_of(const LiveImages& live) {
  OpenCamera camera;
  const CameraMount& mount = live.mounted->mount();
  camera.source.name = mount.name;
  camera.source.parent_link = mount.parent_link;
  camera.source.X_PC = mount.X_PC;
  camera.source.depth_scale_m = live.depth_scale_m;
  camera.source.depth.resize(live.images.size());
  camera.mounted = live.mounted;
  for (const LiveImage& image : live.images) {
    camera.at_exposure.push_back(image.at_exposure);
    camera.exposure_time.emplace_back();
    camera.kept_depth_m.push_back(image.depth_m);
  }
  return camera;
}

/// As if what ran had been recorded.
OpenScene scene_of(const std::vector<LiveImages>& cameras) {
  OpenScene scene;
  for (const LiveImages& live : cameras) {
    scene.robot = live.mounted->robot();
    scene.cameras.push_back(camera_of(live));
  }
  return scene;
}

/// How many images differ from all before them by some joint, by so much (rad or m).
std::size_t count_poses(const LiveImages& live) {
  constexpr double kOtherPose = 0.03;
  std::vector<const std::vector<double>*> poses;
  const auto is_same = [](const std::vector<double>& a, const std::vector<double>& b) {
    return std::ranges::equal(a, b,
                              [](double x, double y) { return std::abs(x - y) < kOtherPose; });
  };
  for (const LiveImage& image : live.images) {
    const std::vector<double>& own = image.at_exposure.position;
    if (std::ranges::none_of(poses, [&](const auto* other) { return is_same(own, *other); }))
      poses.push_back(&own);
  }
  return poses.size();
}

void judge_focal_length(const LiveImages& live, const std::function<void()>& pause,
                        CameraPlausibility& camera) {
  const bool is_asked = live.mounted->settings().watch.min_at_robot > 0 && !camera.is_implausible;
  if (!is_asked || !camera.readings.tells() || count_poses(live) < kLeastPosesForFocalLength) {
    return;
  }
  const OpenScene alone = scene_of({live});
  const SceneCalibrationData material = make_calibration_data(alone);
  const CalibrationResult found =
      calibrate(material.calibration_data, {.is_near = true, .pause = pause});
  if (!found.cameras[0].focal_length_px) return;
  camera.is_implausible = true;
  camera.fits_otherwise = found.cameras[0].refused;
}

}  // namespace

std::vector<CameraPlausibility> find_implausible(const std::vector<LiveImages>& cameras,
                                                 const std::function<void()>& pause) {
  std::vector<CameraPlausibility> found;
  // What runs beside it has the other cores.
  tbb::task_arena(1).execute([&] {
    found = find_implausible(scene_of(cameras));
    for (std::size_t c = 0; c < cameras.size(); ++c) {
      pause();
      judge_focal_length(cameras[c], pause, found[c]);
    }
  });
  return found;
}

}  // namespace berth
