#include "apps/view/calibration_run.hpp"

#include <cmath>
#include <exception>
#include <utility>

#include "berth/reports/calibration_table.hpp"
#include "berth/reports/calibration_words.hpp"
#include "berth/scene/calibrate_scene.hpp"

namespace berth::app {
namespace {

using Json = nlohmann::ordered_json;

/// Thrown where the calibration is to end.
struct CalibrationStopped {};

Json length_or_null(double length_m) { return std::isfinite(length_m) ? Json(length_m) : Json(); }

Json spread_json(const ResidualSpread& spread) {
  return {{"median_m", length_or_null(spread.median_m)}, {"p90_m", length_or_null(spread.p90_m)}};
}

PageMessage state_message(const char* state, const std::string& error = "") {
  return json_message({{"type", "calibration_data"}, {"state", state}, {"error", error}});
}

PageMessage found_message(const SceneCalibrationData& material,
                          const SceneCalibration& calibration) {
  const CalibrationReport report = report_of(material, calibration, false);
  Json cameras = Json::array();
  for (const CameraCalibration& camera : calibration.found.cameras) {
    cameras.push_back({{"name", camera.camera},
                       {"headline", headline(camera)},
                       {"before", spread_json(camera.before)},
                       {"after", spread_json(camera.after)}});
  }
  return json_message({{"type", "calibration_data"},
                       {"state", "found"},
                       {"error", ""},
                       {"cameras", cameras},
                       {"warnings", calibration.warnings},
                       {"report", calibration_table(report)}});
}

}  // namespace

CalibrationRun::CalibrationRun(Publish publish) : publish_(std::move(publish)) {
  publish_("calibration_data", state_message("none"));
}

CalibrationRun::~CalibrationRun() {
  is_stopped_ = true;
  if (thread_.joinable()) thread_.join();
}

void CalibrationRun::start(std::shared_ptr<const OpenScene> scene) {
  if (is_running_ && !is_stopped_) return;
  if (thread_.joinable()) thread_.join();
  is_stopped_ = false;
  is_running_ = true;
  publish_("calibration_data", state_message("runs"));
  thread_ = std::thread([this, scene = std::move(scene)] {
    run(*scene);
    is_running_ = false;
  });
}

void CalibrationRun::drop() {
  const std::scoped_lock lock(mutex_);
  is_stopped_ = true;
  found_.reset();
  publish_("calibration_data", state_message("none"));
}

std::optional<SceneChange> CalibrationRun::take() {
  std::optional<SceneChange> found;
  {
    const std::scoped_lock lock(mutex_);
    found = std::exchange(found_, std::nullopt);
  }
  if (found) publish_("calibration_data", state_message("taken"));
  return found;
}

void CalibrationRun::run(const OpenScene& scene) {
  try {
    CalibrateSceneSettings settings;
    settings.fit.pause = [this] {
      if (is_stopped_) throw CalibrationStopped{};
    };
    const SceneCalibrationData material = make_calibration_data(scene);
    SceneCalibration calibration = calibrate_scene(scene, material, settings);
    const PageMessage message = found_message(material, calibration);
    const std::scoped_lock lock(mutex_);
    if (is_stopped_) return;
    found_ = std::move(calibration.change);
    publish_("calibration_data", message);
  } catch (const CalibrationStopped&) {
    return;
  } catch (const std::exception& error) {
    const std::scoped_lock lock(mutex_);
    if (!is_stopped_) publish_("calibration_data", state_message("failed", error.what()));
  }
}

}  // namespace berth::app
