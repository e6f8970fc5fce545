#include "lab/watch/good_scenes.hpp"

#include "lab/watch/hidden_image.hpp"
#include "lab/watch/mistakes.hpp"
#include "sim/drawn_calibration_data.hpp"
#include "sim/random.hpp"

namespace berth::lab {
namespace {

Eigen::Vector3d direction(sim::Random& random) {
  for (;;) {
    const Eigen::Vector3d v(random(-1, 1), random(-1, 1), random(-1, 1));
    if (v.norm() > 0.1 && v.norm() < 1) return v.normalized();
  }
}

}  // namespace

void move_camera(OpenScene& scene, std::size_t c, double offset_m, double angle_rad,
                 std::uint32_t seed) {
  sim::Random random(300 + seed);
  CameraMount mount = scene.cameras[c].mounted->mount();
  const Eigen::Vector3d offset = offset_m * direction(random);
  mount.X_PC =
      mount.X_PC * Eigen::Translation3d(offset) * Eigen::AngleAxisd(angle_rad, direction(random));
  set_mount(scene, scene.cameras[c], mount);
}

void hide_robot(OpenScene& scene, std::size_t c, std::uint32_t seed) {
  OpenCamera& camera = scene.cameras[c];
  const HiddenImage hidden = hidden_image(camera, seed);
  const std::size_t k = hidden.frame;
  camera.at_exposure = {camera.at_exposure[k]};
  camera.exposure_time = {camera.exposure_time[k]};
  camera.kept_depth_m = {std::make_shared<const DepthImage>(hidden.depth_m)};
  camera.source.depth = {camera.source.depth[k]};
}

OpenScene draw_good_scene(const RobotModel& model, std::uint32_t seed) {
  OpenScene scene;
  scene.file = model.name;
  scene.robot = std::make_shared<const Robot>(model);
  sim::DrawnCalibrationData drawn = sim::draw_calibration_data(
      model, scene.robot->meshes(), {.has_sensor_errors = seed % 2 == 0}, seed);
  scene.joints = std::move(drawn.joints);
  const CalibrationCamera& from = *drawn.camera;
  OpenCamera& camera = scene.cameras.emplace_back();
  camera.source.name = "camera";
  camera.source.parent_link = model.links[from.parent].name;
  camera.source.X_PC = from.X_PC;
  camera.mounted = std::make_shared<const MountedCamera>(
      scene.robot, CameraMount{from.camera, camera.source.parent_link, from.X_PC, "camera"},
      settings_of_real_camera());
  for (std::size_t k = 0; k < from.frames.size(); ++k) {
    camera.source.depth.push_back(std::to_string(k));
    camera.at_exposure.push_back(from.frames[k].joints);
    camera.exposure_time.emplace_back();
    camera.kept_depth_m.push_back(std::make_shared<const DepthImage>(from.frames[k].depth_m));
  }
  scene.frame_count = from.frames.size();
  return scene;
}

}  // namespace berth::lab
