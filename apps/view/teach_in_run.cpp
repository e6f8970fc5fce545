#include "apps/view/teach_in_run.hpp"

#include <cmath>
#include <exception>
#include <utility>

#include "berth/scene/calibrate_scene.hpp"
#include "berth/scene/calibration_table.hpp"
#include "berth/scene/calibration_words.hpp"

namespace berth::app {
namespace {

using TaughtJson = nlohmann::ordered_json;

/// Thrown where the teach-in is to end.
struct TeachInStopped {};

TaughtJson length_or_null(double length_m) {
  return std::isfinite(length_m) ? TaughtJson(length_m) : TaughtJson();
}

TaughtJson spread_json(const ResidualSpread& spread) {
  return {{"median_m", length_or_null(spread.median_m)}, {"p90_m", length_or_null(spread.p90_m)}};
}

PageMessage state_message(const char* state, const std::string& error = "") {
  return json_message({{"type", "teach_in"}, {"state", state}, {"error", error}});
}

PageMessage found_message(const SceneTeachIn& material, const SceneCalibration& calibration) {
  const CalibrationReport report{&material.teach_in, &calibration.found, calibration.filters, false,
                                 calibration.warnings};
  TaughtJson cameras = TaughtJson::array();
  for (const CameraCalibration& camera : calibration.found.cameras) {
    cameras.push_back({{"name", camera.camera},
                       {"headline", headline(camera)},
                       {"before", spread_json(camera.before)},
                       {"after", spread_json(camera.after)}});
  }
  return json_message({{"type", "teach_in"},
                       {"state", "found"},
                       {"error", ""},
                       {"cameras", cameras},
                       {"warnings", calibration.warnings},
                       {"report", calibration_table(report)}});
}

}  // namespace

TeachInRun::TeachInRun(Publish publish) : publish_(std::move(publish)) {
  publish_("teach_in", state_message("none"));
}

TeachInRun::~TeachInRun() {
  is_stopped_ = true;
  if (thread_.joinable()) thread_.join();
}

void TeachInRun::start(std::shared_ptr<const OpenScene> scene) {
  if (is_running_ && !is_stopped_) return;
  if (thread_.joinable()) thread_.join();
  is_stopped_ = false;
  is_running_ = true;
  publish_("teach_in", state_message("runs"));
  thread_ = std::thread([this, scene = std::move(scene)] {
    run(*scene);
    is_running_ = false;
  });
}

void TeachInRun::drop() {
  const std::scoped_lock lock(mutex_);
  is_stopped_ = true;
  found_.reset();
  publish_("teach_in", state_message("none"));
}

std::optional<SceneChange> TeachInRun::take() {
  std::optional<SceneChange> found;
  {
    const std::scoped_lock lock(mutex_);
    found = std::exchange(found_, std::nullopt);
  }
  if (found) publish_("teach_in", state_message("taken"));
  return found;
}

void TeachInRun::run(const OpenScene& scene) {
  try {
    CalibrateSceneSettings settings;
    settings.fit.pause = [this] {
      if (is_stopped_) throw TeachInStopped{};
    };
    const SceneTeachIn material = make_teach_in(scene);
    SceneCalibration calibration = calibrate_scene(scene, material, settings);
    const PageMessage message = found_message(material, calibration);
    const std::scoped_lock lock(mutex_);
    if (is_stopped_) return;
    found_ = std::move(calibration.change);
    publish_("teach_in", message);
  } catch (const TeachInStopped&) {
    return;
  } catch (const std::exception& error) {
    const std::scoped_lock lock(mutex_);
    if (!is_stopped_) publish_("teach_in", state_message("failed", error.what()));
  }
}

}  // namespace berth::app
