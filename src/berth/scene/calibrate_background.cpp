#include "berth/scene/calibrate_background.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "berth/files/png.hpp"
#include "berth/pipeline/observer.hpp"
#include "berth/scene/learn_background.hpp"

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

void require_free_place(const OpenScene& scene, const fs::path& file) {
  const auto fail = [&](const std::string& what) {
    throw std::runtime_error(
        fmt::format("{}: {}; expected --out in another folder", file.string(), what));
  };
  for (const OpenCamera& camera : scene.cameras) {
    const std::string name = camera.source.name;
    if (camera.source.background && is_same_place(*camera.source.background, file)) {
      fail(fmt::format("is camera {}'s background in {}, which is never overwritten", name,
                       scene.file.string()));
    }
    for (const fs::path& image : camera.source.depth) {
      if (!is_same_place(image.parent_path(), fs::absolute(file).parent_path())) continue;
      fail(
          fmt::format("would lie among the images of camera {}, and could be taken for one", name));
    }
  }
}

/// Nearer to the camera by less than a unit, and never farther: what the robot hides there is no
/// farther from it than it was measured.
DepthImage rounded_down(DepthImage depth_m) {
  for (float& z_m : depth_m.pixels()) {
    z_m = static_cast<float>(std::floor(z_m / kBackgroundScale_m + kRounding) * kBackgroundScale_m);
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
                        const std::function<void()>& pause, SceneChange& change) {
  for (const OpenCamera& camera : scene.cameras) {
    if (is_carried(scene, camera) || camera.view->settings().sensor.has_background()) continue;
    change_of(change, camera.source.name).maps["sensor"]["background_frames"] = kAgreeing;
  }
  SceneFile learning = parse_scene(new_file, rewritten_scene(scene.file, change, new_file));
  learning.evaluation.visibility = false;
  for (SceneCamera& camera : learning.cameras) camera.background.reset();
  return open_scene(learning, pause);
}

DepthImage learn(const OpenCamera& camera, const std::function<void()>& pause) {
  Observer observer(camera.view);
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

std::vector<std::string> require_backgrounds(const OpenScene& scene, const fs::path& new_file) {
  std::vector<std::string> carried;
  for (const OpenCamera& camera : scene.cameras) {
    if (is_carried(scene, camera)) {
      carried.push_back(
          fmt::format("camera {}: moves with link \"{}\", so that it has no background",
                      camera.source.name, camera.source.parent_link));
    } else {
      require_free_place(scene, background_file(new_file, camera.source.name));
    }
  }
  if (carried.size() < scene.cameras.size()) return carried;
  throw std::runtime_error(fmt::format(
      "{}: {}; expected no --background, or a camera that is fixed to the root link \"{}\"",
      scene.file.string(), carried[0], scene.robot->model().links.front().name));
}

std::vector<CalibratedBackground> calibrate_backgrounds(const OpenScene& scene,
                                                        const fs::path& new_file,
                                                        const std::function<void()>& pause,
                                                        SceneChange& change) {
  const OpenScene learning = open_learning(scene, new_file, pause, change);
  std::vector<CalibratedBackground> backgrounds;
  for (const OpenCamera& camera : learning.cameras) {
    if (is_carried(learning, camera)) continue;
    const std::string& name = camera.source.name;
    CalibratedBackground& calibrated = backgrounds.emplace_back(
        CalibratedBackground{name, background_file(new_file, name), learn(camera, pause)});
    if (calibrated.known_share() == 0) {
      throw std::runtime_error(fmt::format(
          "{}: camera {}: no background was learned from its {} images; expected a place that {} "
          "of them (sensor.background_frames) show alike, with the robot {:g} m away from it",
          scene.file.string(), name, camera.source.depth.size(),
          camera.view->settings().sensor.background_frames,
          camera.view->settings().sensor.background_clearance_m));
    }
    change_of(change, name).background = calibrated.file;
  }
  return backgrounds;
}

std::vector<std::string> older_backgrounds(const OpenScene& scene) {
  std::vector<std::string> warnings;
  for (const OpenCamera& camera : scene.cameras) {
    if (!camera.source.background) continue;
    warnings.push_back(fmt::format(
        "camera {}: its background was learned before; where the camera was moved since, or its "
        "depth is corrected now, use --background too",
        camera.source.name));
  }
  return warnings;
}

void write_backgrounds(const std::vector<CalibratedBackground>& backgrounds) {
  for (const CalibratedBackground& calibrated : backgrounds) {
    write_depth_png(calibrated.file, calibrated.depth_m, kBackgroundScale_m);
  }
}

}  // namespace berth
