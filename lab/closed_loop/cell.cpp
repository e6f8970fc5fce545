#include "lab/closed_loop/cell.hpp"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "berth/files/file_bytes.hpp"
#include "berth/separation/protective_distance.hpp"
#include "sim/bundled_camera.hpp"
#include "sim/room.hpp"

namespace berth::lab {
namespace {

/// The bundled URDF with a floor.
std::string cell_urdf(const std::string& file) {
  std::string urdf = read_file_bytes(file);
  const std::string floor = fmt::format(
      "<link name=\"floor\"><visual><geometry><box size=\"8 8 0.1\"/></geometry></visual></link>\n"
      "<joint name=\"floor\" type=\"fixed\"><parent link=\"table\"/><child link=\"floor\"/>"
      "<origin xyz=\"0 0 {}\"/></joint>\n",
      sim::kFloorZ_m - 0.05);
  return urdf.insert(urdf.rfind("</robot>"), floor);
}

int speckle_px(const Camera& camera, double detection_m) {
  constexpr double kFar_m = 2.2, kShare = 0.4;
  const double diameter_px = camera.fx_px * detection_m / kFar_m;
  return static_cast<int>(std::lround(kShare * std::numbers::pi / 4 * diameter_px * diameter_px));
}

}  // namespace

const RobotModel& cell_model() {
  static const RobotModel model = [] {
    const std::string folder = BERTH_BUNDLED_ARM;
    RobotSettings settings;
    settings.urdf = folder + "/arm.urdf";
    settings.package_paths["berth_arm"] = folder;
    settings.environment_links = {"table", "floor"};
    settings.urdf_text = cell_urdf(settings.urdf);
    return load_robot(settings);
  }();
  return model;
}

std::vector<CellCamera> cell_cameras() {
  std::vector<CellCamera> cameras;
  for (const sim::BundledCamera& camera : sim::bundled_cameras()) {
    cameras.push_back({camera.name, camera.camera, camera.place.X_TC()});
  }
  return cameras;
}

SeparationSettings cell_separation(double request_hz, double detection_m) {
  SeparationSettings settings;
  settings.deceleration_m_s2 = kArmDeceleration_m_s2;
  settings.acceleration_m_s2 = kArmAcceleration_m_s2;
  settings.reaction_time_s = 1 / request_hz + kLateController * kController_s;
  settings.detection_m = detection_m;
  settings.camera_uncertainty_m = kCellReadingError_m;
  // Everything that is drawn has readings.
  settings.no_reading = UnknownPolicy::ignore;
  return settings;
}

double conforming_zone_m(double robot_m_s) {
  // The arm's farthest point from the base's axis on its way.
  constexpr double kReach_m = 0.67;
  constexpr double kScanner_s = 0.08, kScanner_hz = 50;
  SeparationSettings settings = cell_separation(kScanner_hz);
  settings.detection_m.reset();
  const ProtectiveTerms terms{settings.reaction_time_s + kScanner_s, 0};
  return kReach_m + protective_distance_m(settings, terms, {robot_m_s, robot_m_s});
}

std::shared_ptr<const Robot> cell_robot(std::optional<double> deadline_us) {
  const auto make = [&] {
    EvaluationSettings settings;
    settings.distance.range_m = kCellRange_m;
    settings.distance.deadline_us = deadline_us;
    return std::make_shared<const Robot>(cell_model(), settings);
  };
  if (deadline_us) return make();
  static const std::shared_ptr<const Robot> robot = make();
  return robot;
}

std::vector<std::shared_ptr<const MountedCamera>> mounted_cell_cameras(
    const std::shared_ptr<const Robot>& robot, const std::vector<int>& cameras,
    double detection_m) {
  const std::vector<CellCamera> all = cell_cameras();
  CameraSettings settings = settings_of_real_camera();
  settings.sensor.speckle_px = speckle_px(all.front().camera, detection_m);
  settings.space.detection_capability_m = detection_m;
  std::vector<std::shared_ptr<const MountedCamera>> mounted;
  for (const int camera : cameras) {
    mounted.push_back(std::make_shared<const MountedCamera>(
        robot,
        CameraMount{all[camera].camera, robot->model().links.front().name, all[camera].X_BC,
                    all[camera].name},
        settings));
  }
  return mounted;
}

}  // namespace berth::lab
