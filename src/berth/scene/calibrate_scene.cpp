#include "berth/scene/calibrate_scene.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "berth/calibration/moved_environment.hpp"
#include "berth/robot/kinematics.hpp"
#include "berth/scene/calibrated_robot.hpp"
#include "berth/scene/plausibility.hpp"
#include "berth/separation/protective_distance.hpp"
#include "berth/watch/frame_displacement.hpp"
#include "berth/watch/seen_through.hpp"

namespace berth {
namespace {

/// More show the room again.
constexpr std::size_t kMostImages = 10;

std::vector<DetectionImage> images_of(CalibratedRobot& calibrated, const RobotModel& model,
                                      bool corrects_depth) {
  std::vector<DetectionImage> images;
  const std::vector<CalibrationFrame>& frames = calibrated.source().frames;
  const std::size_t step = (frames.size() + kMostImages - 1) / kMostImages;
  RobotPose pose;
  for (std::size_t k = 0; k < frames.size(); k += step) {
    const RobotImage* robot = calibrated.draw(k, CalibrationSide::after);
    if (!robot) continue;
    forward_kinematics(model, calibrated.joints(k, CalibrationSide::after)->position, pose);
    const Pose X_BC = pose.X_BL[calibrated.source().parent] * calibrated.found().X_PC;
    const DepthImage& depth_m = frames[k].depth_m;
    images.push_back(
        {corrects_depth ? corrected(depth_m, calibrated.found().depth) : depth_m, *robot, X_BC});
    pose_soft_bodies(model, pose, X_BC, images.back().soft);
  }
  return images;
}

}  // namespace

DetectionMap measure_detection_of(const CalibrationData& calibration_data,
                                  const CalibrationResult& found,
                                  const std::vector<FilterProposal>& filters, bool corrects_depth,
                                  const std::function<void()>& pause) {
  std::vector<DetectionCamera> cameras;
  for (std::size_t c = 0; c < filters.size(); ++c) {
    cameras.push_back({calibration_data.cameras[c]->camera,
                       filters[c].self_filter_settings,
                       filters[c].sensor_settings,
                       {}});
    CalibratedRobot calibrated(calibration_data, found, c);
    cameras.back().images = images_of(calibrated, *calibration_data.model, corrects_depth);
  }
  return measure_detection(cameras, robot_reach(*calibration_data.model), pause);
}

namespace {

/// The number of frames in which D is measured: it takes a tenth of a second.
constexpr std::size_t kMostDisplacements = 10;

/// Where no pose explains the images, a simple mistake may.
void require_poses(const OpenScene& scene, const CalibrationResult& found) {
  for (std::size_t c = 0; c < found.cameras.size(); ++c) {
    const CameraCalibration& camera = found.cameras[c];
    if (camera.is_found) continue;
    const CameraPlausibility why = find_implausible(scene, c);
    throw std::runtime_error(fmt::format(
        "{}: camera {}: {}", scene.file.string(), camera.camera,
        why.cause.empty() && why.dead.empty() ? camera.refused : text_without_name(why)));
  }
}

/// T and D of the frames that were used, with the camera where it was found.
WatchSettings normal_range(const CalibrationData& calibration_data, std::size_t camera,
                           const CalibrationResult& result, const CalibrateSceneSettings& settings,
                           double bias_m) {
  CalibratedRobot calibrated(calibration_data, result, camera);
  const CalibrationCamera& source = calibrated.source();
  const FrameDisplacement displacement(*calibration_data.model, calibration_data.meshes,
                                       source.camera, source.parent, calibrated.found().X_PC,
                                       bias_m);
  std::vector<double> seen_through;
  std::vector<double> displacement_m;
  for (std::size_t k = 0; k < source.frames.size(); ++k) {
    settings.fit.pause();
    const RobotImage* robot = calibrated.draw(k, CalibrationSide::after);
    if (!robot) continue;
    DepthImage depth_m = source.frames[k].depth_m;
    if (settings.correct_depth) depth_m = corrected(depth_m, calibrated.found().depth);
    seen_through.push_back(read_robot(depth_m, *robot, bias_m).seen_through());
    if (displacement_m.size() >= kMostDisplacements) continue;
    displacement_m.push_back(
        displacement.measure(depth_m, *calibrated.joints(k, CalibrationSide::after))
            .value_or(std::numeric_limits<double>::quiet_NaN()));
  }
  WatchSettings watch = learned_limits(seen_through, displacement_m);
  watch.bias_m = bias_m;
  return watch;
}

/// To a thousandth: more digits would say nothing.
double rounded_up(double value) { return std::ceil(1000 * value) / 1000; }

std::map<std::string, double> as_map(const std::vector<ProposedSetting>& proposed) {
  std::map<std::string, double> map;
  for (const ProposedSetting& one : proposed) map[one.key] = one.value;
  return map;
}

SceneCameraChange change_of(const SceneCamera& source, const CameraCalibration& found,
                            const FilterProposal& filter, const WatchSettings& watch,
                            bool correct_depth) {
  SceneCameraChange change;
  change.camera = source.name;
  if (found.refused.empty()) {
    change.X_PC = found.X_PC;
    if (found.is_determined("clock_offset_s")) change.clock_offset_s = found.clock_offset_s;
    if (correct_depth) {
      change.depth_scale_m = found.depth.scale * source.depth_scale_m;
      change.depth_offset_m = found.depth.offset_m + found.depth.scale * source.depth_offset_m;
    }
  }
  change.maps["self_filter"] = as_map(filter.self_filter);
  change.maps["sensor"] = as_map(filter.sensor);
  std::map<std::string, double>& limits = change.maps["watch"];
  if (watch.max_seen_through > 0) limits["max_seen_through"] = rounded_up(watch.max_seen_through);
  if (watch.max_displacement_m > 0) {
    limits["max_displacement_m"] = rounded_up(watch.max_displacement_m);
  }
  if (watch.is_on()) limits["bias_m"] = std::round(1000 * watch.bias_m) / 1000 + 0.0;
  std::erase_if(change.maps, [](const auto& map) { return map.second.empty(); });
  return change;
}

/// One sentence for each camera, about the greatest change.
void warn_of_changes(const std::vector<EnvironmentChange>& changes, const std::string& camera,
                     std::vector<std::string>& warnings) {
  const EnvironmentChange* greatest = nullptr;
  for (const EnvironmentChange& one : changes) {
    if (one.camera == camera && (!greatest || one.share > greatest->share)) greatest = &one;
  }
  if (!greatest) return;
  warnings.push_back(fmt::format(
      "camera {}: something beside the robot moved, most of all between frames {} and {} ({:.0f} % "
      "of what is seen there); expected fixed things alone",
      camera, greatest->before, greatest->after, 100 * greatest->share));
}

std::vector<std::string> warnings_of(const SceneCalibrationData& material,
                                     const CalibrationResult& found) {
  std::vector<std::string> warnings = material.warnings;
  const std::vector<EnvironmentChange> changes =
      moved_environment(material.calibration_data, found);
  for (const CameraCalibration& camera : found.cameras) {
    warn_of_changes(changes, camera.camera, warnings);
  }
  return warnings;
}

/// What the monitor is told from now on: what is detected wherever a camera looks, and no less than
/// what may hide from a camera.
void tell_monitor(const OpenScene& scene, SceneCalibration& calibration) {
  double told_m = calibration.detection.cell.worst_m();
  if (!scene.separation || std::isnan(told_m)) return;
  if (std::isinf(told_m)) {
    return calibration.warnings.push_back(fmt::format(
        "separation.detection_m stays as it is; at some places in view not even balls of {:.0f} mm "
        "are detected",
        1000 * kDrawnDiameters_m.back()));
  }
  for (const OpenCamera& camera : scene.cameras) {
    told_m = std::max(
        told_m, detection_capability_m(camera.mounted->settings().space, camera.mounted->camera()));
  }
  calibration.change.values[{"separation", "detection_m"}] = fmt::format("{}", told_m);
  SeparationSettings settings = *scene.separation;
  const double before_m = settings.detection_m.value_or(told_m);
  if (!(before_m < told_m)) return;
  const double intrusion_before_m = intrusion_m(settings);
  settings.detection_m = told_m;
  calibration.warnings.push_back(fmt::format(
      "separation.detection_m: {} becomes {}, since at some places in view nothing smaller is "
      "detected; C, how far a part of a body may reach undetected, was {:.2f} m and becomes {:.2f} "
      "m",
      before_m, told_m, intrusion_before_m, intrusion_m(settings)));
}

}  // namespace

SceneCalibration calibrate_scene(const OpenScene& scene, const SceneCalibrationData& material,
                                 const CalibrateSceneSettings& settings) {
  SceneCalibration calibration;
  calibration.found = calibrate(material.calibration_data, settings.fit);
  const CalibrationResult& found = calibration.found;
  require_poses(scene, found);
  calibration.warnings = warnings_of(material, found);
  calibration.attached = find_attached_parts(material.calibration_data, found, settings.fit.pause);
  for (AttachedPart& part : calibration.attached.parts) {
    part.is_taken = settings.takes_part(part, found);
  }
  const CarryingRobotData carrying(material.calibration_data, calibration.attached);
  const CalibrationData& calibration_data = carrying.calibration_data();
  for (std::size_t c = 0; c < scene.cameras.size(); ++c) {
    settings.fit.pause();
    const CameraSettings& present = scene.cameras[c].mounted->settings();
    const bool corrects = settings.correct_depth && found.cameras[c].refused.empty();
    calibration.filters.push_back(
        propose_filter(calibration_data, c, found, corrects, present.self_filter, present.sensor));
    calibration.watches.push_back(
        normal_range(calibration_data, c, found, settings, calibration.filters[c].bias_m));
    calibration.change.cameras.push_back(change_of(scene.cameras[c].source, found.cameras[c],
                                                   calibration.filters[c], calibration.watches[c],
                                                   corrects));
  }
  calibration.detection = measure_detection_of(calibration_data, found, calibration.filters,
                                               settings.correct_depth, settings.fit.pause);
  tell_monitor(scene, calibration);
  for (const auto& [joint, offset] : found.joint_offsets) {
    const auto before = scene.joint_offsets.find(joint);
    calibration.change.joint_offsets[joint] =
        offset + (before == scene.joint_offsets.end() ? 0 : before->second);
  }
  return calibration;
}

}  // namespace berth
