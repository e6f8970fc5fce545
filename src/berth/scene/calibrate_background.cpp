#include "berth/scene/calibrate_background.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "berth/files/png.hpp"
#include "berth/pipeline/observer.hpp"
#include "berth/scene/camera_frames.hpp"

namespace berth {
namespace {

namespace fs = std::filesystem;

/// Images that have to agree, where the scene does not say how many.
constexpr int kAgreeing = 3;
/// Of a unit: what rounding leaves of a reading in whole units.
constexpr double kRounding = 1e-3;

bool is_carried(const OpenScene& scene, const OpenCamera& camera) {
  const RobotModel& model = scene.robot->model();
  return model.is_moved(*model.find_link(camera.source.parent_link));
}

bool is_same_place(const fs::path& a, const fs::path& b) {
  return fs::weakly_canonical(fs::absolute(a)) == fs::weakly_canonical(fs::absolute(b));
}

/// Why this camera gets no background in that file; empty where it may.
std::string why_none(const OpenScene& scene, const OpenCamera& camera, const fs::path& file) {
  if (is_carried(scene, camera)) {
    return fmt::format("moves with link \"{}\"", camera.source.parent_link);
  }
  for (const OpenCamera& other : scene.cameras) {
    if (other.source.background && is_same_place(*other.source.background, file)) {
      return fmt::format(
          "{} is camera {}'s in {}, which is never overwritten; choose another folder",
          file.string(), other.source.name, scene.file.string());
    }
    for (const fs::path& image : other.source.depth) {
      if (!is_same_place(fs::absolute(image).parent_path(), fs::absolute(file).parent_path()))
        continue;
      return fmt::format("{} would lie among the images of camera {}; choose another folder",
                         file.string(), other.source.name);
    }
  }
  return {};
}

/// Nearer to the camera by less than a unit, and never farther: what the robot hides there is no
/// farther from it than it was measured. A file has no place for readings of unknown depth.
DepthImage rounded_down(DepthImage depth_m) {
  for (float& z_m : depth_m.pixels()) {
    z_m = std::isfinite(z_m) ? static_cast<float>(std::floor(z_m / kBackgroundScale_m + kRounding) *
                                                  kBackgroundScale_m)
                             : kNoDepth;
  }
  return depth_m;
}

SceneCameraChange& change_of(SceneChange& change, const std::string& camera) {
  const auto named = [&](const SceneCameraChange& one) { return one.camera == camera; };
  const auto at = std::find_if(change.cameras.begin(), change.cameras.end(), named);
  if (at != change.cameras.end()) return *at;
  change.cameras.push_back({});
  change.cameras.back().camera = camera;
  return change.cameras.back();
}

/// The new scene, whose fixed cameras learn from their own images.
OpenScene open_learning(const OpenScene& scene, const fs::path& new_file,
                        const std::function<void()>& pause, SceneChange change) {
  for (const OpenCamera& camera : scene.cameras) {
    if (is_carried(scene, camera) || camera.mounted->settings().sensor.has_background()) continue;
    change_of(change, camera.source.name).maps["sensor"]["background_frames"] = kAgreeing;
  }
  SceneFile learning = parse_scene(new_file, rewritten_scene(scene.file, change, new_file));
  learning.evaluation.visibility = false;
  for (SceneCamera& camera : learning.cameras) camera.background.reset();
  return open_scene(learning, pause);
}

DepthImage learn(const OpenCamera& camera, const std::function<void()>& pause) {
  Observer observer(camera.mounted);
  learn_background(
      camera, {{0, camera.source.depth.size()}}, pause,
      [&](DepthView depth_m, const Frame& frame) { observer.learn_background(depth_m, frame); });
  return rounded_down(observer.background_m());
}

}  // namespace

double CalibratedBackground::known_share() const {
  const auto known = std::count_if(depth_m.pixels().begin(), depth_m.pixels().end(),
                                   [](float z_m) { return !std::isnan(z_m); });
  return static_cast<double>(known) / static_cast<double>(depth_m.pixels().size());
}

fs::path background_file(const fs::path& new_file, const std::string& camera) {
  return new_file.parent_path() /
         fmt::format("{}.background.{}.png", new_file.stem().string(), camera);
}

CalibratedBackgrounds calibrate_backgrounds(const OpenScene& scene, const fs::path& new_file,
                                            const std::function<void()>& pause,
                                            SceneChange& change) {
  const OpenScene learning = open_learning(scene, new_file, pause, change);
  CalibratedBackgrounds all;
  for (std::size_t i = 0; i < learning.cameras.size(); ++i) {
    const OpenCamera& camera = learning.cameras[i];
    const std::string& name = camera.source.name;
    CalibratedBackground calibrated{name, background_file(new_file, name), {}};
    std::string why = why_none(scene, camera, calibrated.file);
    if (why.empty()) {
      calibrated.depth_m = learn(camera, pause);
      if (calibrated.known_share() == 0) {
        why = fmt::format(
            "{} of its {} images have to show a place alike, with the robot {:g} m away",
            camera.mounted->settings().sensor.background_frames, camera.source.depth.size(),
            camera.mounted->settings().sensor.background_clearance_m);
      }
    }
    if (!why.empty()) {
      all.without.push_back(fmt::format("camera {}: no background was learned: {}", name, why));
      continue;
    }
    SceneCameraChange& of_camera = change_of(change, name);
    of_camera.background = calibrated.file;
    if (!scene.cameras[i].mounted->settings().sensor.has_background()) {
      of_camera.maps["sensor"]["background_frames"] = kAgreeing;
    }
    all.learned.push_back(std::move(calibrated));
  }
  return all;
}

void write_backgrounds(const std::vector<CalibratedBackground>& backgrounds) {
  for (const CalibratedBackground& calibrated : backgrounds) {
    write_depth_png(calibrated.file, calibrated.depth_m, kBackgroundScale_m);
  }
}

}  // namespace berth
