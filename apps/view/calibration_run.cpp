#include "apps/view/calibration_run.hpp"

#include <cmath>
#include <exception>
#include <utility>

#include "apps/view/part_pictures.hpp"
#include "berth/reports/calibration_report.hpp"
#include "berth/reports/calibration_words.hpp"

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

PageMessage question_message(const AttachedPart& part, const std::vector<PartPicture>& pictures) {
  Json entries = Json::array();
  std::vector<std::span<const std::byte>> arrays;
  for (const PartPicture& one : pictures) {
    entries.push_back({{"camera", one.camera}, {"frame", one.frame}, {"bytes", one.png.size()}});
    arrays.push_back(std::as_bytes(std::span(one.png)));
  }
  return binary_message({{"type", "calibration_data"},
                         {"state", "asks"},
                         {"error", ""},
                         {"part", part.name},
                         {"question", attached_text(part)},
                         {"pictures", entries}},
                        arrays);
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
  {
    const std::scoped_lock lock(mutex_);
    is_stopped_ = true;
  }
  answered_.notify_all();
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

void CalibrationRun::answer(const std::string& part, bool is_taken) {
  {
    const std::scoped_lock lock(mutex_);
    if (part != asked_) return;
    answer_ = is_taken;
  }
  answered_.notify_all();
}

void CalibrationRun::drop() {
  {
    const std::scoped_lock lock(mutex_);
    is_stopped_ = true;
    found_.reset();
    publish_("calibration_data", state_message("none"));
  }
  answered_.notify_all();
}

std::optional<SceneCalibration> CalibrationRun::take() {
  std::optional<SceneCalibration> found;
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
    settings.takes_part = [&](const AttachedPart& part, const CalibrationResult& found) {
      return ask(material, part, found);
    };
    SceneCalibration calibration = calibrate_scene(scene, material, settings);
    const PageMessage message = found_message(material, calibration);
    const std::scoped_lock lock(mutex_);
    if (is_stopped_) return;
    found_ = std::move(calibration);
    publish_("calibration_data", message);
  } catch (const CalibrationStopped&) {
    return;
  } catch (const std::exception& error) {
    const std::scoped_lock lock(mutex_);
    if (!is_stopped_) publish_("calibration_data", state_message("failed", error.what()));
  }
}

bool CalibrationRun::ask(const SceneCalibrationData& material, const AttachedPart& part,
                         const CalibrationResult& found) {
  const PageMessage question =
      question_message(part, part_pictures(material.calibration_data, found, part));
  std::unique_lock lock(mutex_);
  if (is_stopped_) throw CalibrationStopped{};
  asked_ = part.name;
  answer_.reset();
  publish_("calibration_data", question);
  answered_.wait(lock, [this] { return is_stopped_ || answer_; });
  asked_.clear();
  if (is_stopped_) throw CalibrationStopped{};
  publish_("calibration_data", state_message("runs"));
  return *answer_;
}

}  // namespace berth::app
