#include "berth/scene/scene_calibration.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace berth {
namespace {

/// Two frames show different poses where some joint differs by this, rad or m.
constexpr double kOtherPose = 0.05;
constexpr double kStandsStill = 0.01;
constexpr std::size_t kGoodPoses = 5;
constexpr std::size_t kLeastPoses = 3;

double farthest_joint(const JointState& a, const JointState& b) {
  double farthest = 0;
  for (std::size_t j = 0; j < a.position.size(); ++j) {
    farthest = std::max(farthest, std::abs(a.position[j] - b.position[j]));
  }
  return farthest;
}

/// Of the frames whose joints are known, in their order.
std::vector<std::size_t> usable_frames(const OpenCamera& camera) {
  std::vector<std::size_t> usable;
  for (std::size_t f = 0; f < camera.source.depth.size(); ++f) {
    if (camera.exposure_time[f].status == TimeStatus::ok) usable.push_back(f);
  }
  return usable;
}

/// One after another, the one that differs most from all that were chosen before; the order is that
/// of the images.
std::vector<std::size_t> different_frames(const OpenCamera& camera,
                                          const std::vector<std::size_t>& usable) {
  std::vector<std::size_t> chosen{usable.front()};
  std::vector<double> farness(usable.size(), std::numeric_limits<double>::infinity());
  while (chosen.size() < std::min(usable.size(), kMostCalibrationFrames)) {
    std::size_t best = 0;
    for (std::size_t i = 0; i < usable.size(); ++i) {
      farness[i] = std::min(farness[i], farthest_joint(camera.at_exposure[usable[i]],
                                                       camera.at_exposure[chosen.back()]));
      if (farness[i] > farness[best]) best = i;
    }
    if (farness[best] == 0) break;
    chosen.push_back(usable[best]);
  }
  std::sort(chosen.begin(), chosen.end());
  return chosen;
}

std::size_t count_poses(const OpenCamera& camera, const std::vector<std::size_t>& frames) {
  std::vector<std::size_t> poses;
  for (const std::size_t f : frames) {
    const bool is_new = std::all_of(poses.begin(), poses.end(), [&](std::size_t other) {
      return farthest_joint(camera.at_exposure[f], camera.at_exposure[other]) > kOtherPose;
    });
    if (is_new) poses.push_back(f);
  }
  return poses.size();
}

[[noreturn]] void fail(const OpenScene& scene, const std::string& camera, std::string_view what) {
  throw std::runtime_error(fmt::format("{}: camera {}: {}", scene.file.string(), camera, what));
}

void require_movement(const OpenScene& scene, const OpenCamera& camera,
                      const std::vector<std::size_t>& usable) {
  if (usable.empty()) {
    fail(scene, camera.source.name,
         "no frame has joint angles; expected five poses of the arm at least");
  }
  double farthest = 0;
  for (const std::size_t f : usable) {
    farthest =
        std::max(farthest, farthest_joint(camera.at_exposure[usable[0]], camera.at_exposure[f]));
  }
  if (farthest >= kStandsStill) return;
  fail(scene, camera.source.name,
       fmt::format("the arm never moves in its {} frame{}; expected five poses that differ by some "
                   "tenths of a radian",
                   usable.size(), usable.size() == 1 ? "" : "s"));
}

void warn(const OpenCamera& camera, const std::vector<std::size_t>& usable,
          std::vector<std::string>& warnings) {
  const std::size_t missing = camera.source.depth.size() - usable.size();
  if (missing > 0) {
    warnings.push_back(
        fmt::format("camera {}: {} of {} frames are not used: there are no joint "
                    "angles for their stamps",
                    camera.source.name, missing, camera.source.depth.size()));
  }
  const std::size_t poses = count_poses(camera, usable);
  if (poses < kLeastPoses) {
    warnings.push_back(
        fmt::format("camera {}: only {} different poses of the arm: the result is "
                    "not checked by other poses; take five or more",
                    camera.source.name, poses));
  } else if (poses < kGoodPoses) {
    warnings.push_back(
        fmt::format("camera {}: {} different poses of the arm; five or more are "
                    "better",
                    camera.source.name, poses));
  }
}

}  // namespace

SceneFile read_scene_to_calibrate(const std::filesystem::path& file) {
  SceneFile scene = read_scene(file);
  scene.evaluation.visibility = false;
  return scene;
}

SceneCalibrationData make_calibration_data(const OpenScene& scene) {
  SceneCalibrationData material;
  material.calibration_data.model = &scene.robot->model();
  material.calibration_data.meshes = scene.robot->meshes();
  for (const OpenCamera& from : scene.cameras) {
    const std::vector<std::size_t> usable = usable_frames(from);
    require_movement(scene, from, usable);
    warn(from, usable, material.warnings);
    auto camera = std::make_unique<CalibrationCamera>();
    camera->name = from.source.name;
    camera->camera = from.mounted->camera();
    camera->parent = *scene.robot->model().find_link(from.source.parent_link);
    camera->X_PC = from.source.X_PC;
    camera->clock_offset_s = from.source.clock_offset_s;
    camera->has_stamps = !from.source.stamps_s.empty();
    if (camera->has_stamps) material.calibration_data.joints = scene.joints.get();
    for (const std::size_t f : different_frames(from, usable)) {
      camera->frames.push_back({static_cast<int>(f), from.read_depth(f), from.at_exposure[f]});
    }
    material.calibration_data.cameras.push_back(camera.get());
    material.cameras.push_back(std::move(camera));
  }
  return material;
}

}  // namespace berth
