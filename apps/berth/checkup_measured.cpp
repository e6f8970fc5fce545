// The checks that measure: what the cameras detect, and how long this machine takes.
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "apps/berth/checkup.hpp"
#include "berth/calibration/filter_settings.hpp"
#include "berth/pipeline/observer.hpp"
#include "berth/pipeline/query.hpp"
#include "berth/scene/scene_calibration.hpp"

namespace berth::app {
namespace {

constexpr std::size_t kTimedImages = 20;
/// A piece beside the robot of fewer pixels goes with the rules for speckle and phantoms.
constexpr int kLeastPiece_px = 20;
/// More than this share of the time between two images, on all cameras together, leaves too little
/// for requests.
constexpr double kMostOfTime = 0.8;

/// What calibration would find if the scene were right.
CalibrationResult as_the_scene_says(const SceneCalibrationData& material) {
  CalibrationResult result;
  for (const auto& camera : material.cameras) {
    CameraCalibration& same = result.cameras.emplace_back();
    same.camera = camera->name;
    same.X_PC = camera->X_PC;
    same.clock_offset_s = camera->clock_offset_s;
  }
  return result;
}

std::string width_text(double width_m) {
  return std::isnan(width_m) ? "more than 30 mm" : fmt::format("{:.0f} mm", 1000 * width_m);
}

/// The widest of what is needed at all depths, endless where nothing that was drawn is seen; 0
/// where nothing was measured.
double worst_finger_m(const FilterProposal& filter) {
  double worst_m = 0;
  for (const SmallestObstacle& one : filter.smallest) {
    worst_m = std::max(worst_m, std::isnan(one.finger_width_m) ? HUGE_VAL : one.finger_width_m);
  }
  return worst_m;
}

std::string what_to_write(double worst_m, const std::string& camera) {
  if (std::isinf(worst_m)) {
    return fmt::format(
        "Take separation.detection_m out, or move camera {} nearer: no fingertip of up to 30 mm "
        "was "
        "seen.",
        camera);
  }
  return fmt::format(
      "Write separation.detection_m: {:.3f} at least, or show that camera {} needs less.", worst_m,
      camera);
}

Finding detection_of(const OpenScene& scene, const OpenCamera& camera,
                     const FilterProposal& filter) {
  Finding found{.about = "detection, camera " + camera.source.name};
  for (const SmallestObstacle& one : filter.smallest) {
    found.text += fmt::format(
        "{}at {:.1f} m a rod of {} and a fingertip of {}",
        found.text.empty() ? "with the settings that berth calibrate would write, it detects "
                           : ", ",
        one.depth_m, width_text(one.rod_width_m), width_text(one.finger_width_m));
  }
  if (filter.smallest.empty()) found.text = "no image has room to measure it";
  found.text += fmt::format(
      "; a thing of {:.0f} mm or more is not lost among pixels without a reading",
      1000 * detection_capability_m(camera.mounted->settings().space, camera.mounted->camera()));
  // Endless where it promises nothing.
  const double promised_m =
      scene.separation ? scene.separation->detection_m.value_or(HUGE_VAL) : HUGE_VAL;
  const double worst_m = worst_finger_m(filter);
  if (promised_m < worst_m) {
    found.verdict = Verdict::wrong;
    found.text += fmt::format("; separation.detection_m says {:.0f} mm", 1000 * promised_m);
    found.next = what_to_write(worst_m, camera.source.name);
  } else if (filter.largest_leftover_px >= kLeastPiece_px) {
    found.verdict = Verdict::advice;
    found.text += fmt::format(
        "; these settings leave {} pixels close to the robot as an obstacle, {} of them in one "
        "piece",
        filter.leftover_px, filter.largest_leftover_px);
    found.next = fmt::format(
        "Look whether something stands close to the robot: berth run {} --picture pictures. If "
        "nothing does, raise self_filter.padding_m or sensor.speckle_px.",
        scene.file.string());
  }
  return found;
}

double milliseconds_since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start)
      .count();
}

double median(std::vector<double> values) {
  std::ranges::nth_element(values, values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2));
  return values[values.size() / 2];
}

/// The median of some images, and the last frame.
double observe_ms(const OpenCamera& camera, const Pause& pause, Frame& frame) {
  Observer observer(camera.mounted);
  std::vector<double> times_ms;
  const std::size_t images = std::min(camera.source.depth.size(), kTimedImages);
  for (std::size_t k = 0; k < images; ++k) {
    pause();
    const DepthImage depth_m = camera.read_depth(k);
    const auto start = std::chrono::steady_clock::now();
    observer.observe(depth_m, camera.at_exposure[k], frame, camera.exposure_time[k]);
    times_ms.push_back(milliseconds_since(start));
  }
  observer.finish_watch(frame);
  return median(times_ms);
}

/// The median of requests about these frames, with the joints of images of the first camera; but
/// the first request.
double ask_ms(const OpenScene& scene, const std::vector<std::shared_ptr<const Frame>>& frames,
              const Pause& pause) {
  const std::vector<JointState>& poses = scene.cameras.front().at_exposure;
  Query query(scene.robot);
  std::vector<double> times_ms;
  for (std::size_t i = 0; i <= kTimedImages; ++i) {
    pause();
    const auto start = std::chrono::steady_clock::now();
    query.ask({.frames = frames, .joints = poses[i % poses.size()]});
    if (i > 0) times_ms.push_back(milliseconds_since(start));
  }
  return median(times_ms);
}

}  // namespace

double period_ms(const OpenCamera& camera) {
  const std::vector<double>& stamps_s = camera.source.stamps_s;
  if (stamps_s.size() < 2) return std::numeric_limits<double>::quiet_NaN();
  return 1000 * (stamps_s.back() - stamps_s.front()) / static_cast<double>(stamps_s.size() - 1);
}

std::vector<Finding> check_detection(const OpenScene& scene) {
  std::vector<Finding> all;
  SceneCalibrationData material;
  try {
    material = make_calibration_data(scene);
  } catch (const std::runtime_error& error) {
    return {{Verdict::advice, "detection", error.what(),
             "Record images in which the arm moves: without them nothing tells what the cameras "
             "show."}};
  }
  const CalibrationResult found = as_the_scene_says(material);
  for (std::size_t c = 0; c < scene.cameras.size(); ++c) {
    const CameraSettings& settings = scene.cameras[c].mounted->settings();
    all.push_back(detection_of(scene, scene.cameras[c],
                               propose_filter(material.calibration_data, c, found, false,
                                              settings.self_filter, settings.sensor)));
  }
  return all;
}

std::vector<Finding> check_time(const OpenScene& scene, const Pause& pause) {
  std::vector<Finding> all;
  std::vector<std::shared_ptr<const Frame>> frames;
  double busy = 0;
  for (const OpenCamera& camera : scene.cameras) {
    const auto frame = std::make_shared<Frame>();
    const double took_ms = observe_ms(camera, pause, *frame), between_ms = period_ms(camera);
    frames.push_back(frame);
    Finding found{.about = "time, camera " + camera.source.name,
                  .text = fmt::format("{:.1f} ms for an image", took_ms)};
    if (!std::isnan(between_ms)) {
      busy += took_ms / between_ms;
      found.text += fmt::format(", one comes each {:.1f} ms", between_ms);
    }
    all.push_back(found);
  }
  Finding requests{.about = "time"};
  requests.text = fmt::format(
      "{:.2f} ms for a request; {}", ask_ms(scene, frames, pause),
      busy > 0 ? fmt::format("images take {:.0f} % of this machine's time", 100 * busy)
               : "without stamps it is not known how much of this machine's time images take");
  if (busy > kMostOfTime) {
    requests.verdict = Verdict::wrong;
    requests.next =
        "Give berth more or faster processors, smaller images, or fewer images a second.";
  }
  all.push_back(requests);
  return all;
}

}  // namespace berth::app
