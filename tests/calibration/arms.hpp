// Robots that calibration is tested with.
#pragma once

#include <filesystem>

#include "berth/calibration/calibrate.hpp"
#include "berth/render/robot_renderer.hpp"
#include "sim/drawn_calibration_data.hpp"
#include "tests/support/coarse_arm.hpp"

namespace berth {

struct Arm {
  RobotModel model;
  std::shared_ptr<const LinkMeshes> meshes;

  explicit Arm(const RobotSettings& settings)
      : model(load_robot(settings)), meshes(build_link_meshes(model)) {}

  sim::DrawnCalibrationData draw(const sim::DrawnCalibrationSettings& settings,
                                 std::uint32_t seed) const {
    return sim::draw_calibration_data(model, meshes, settings, seed);
  }
};

inline Arm arm_of(const std::filesystem::path& folder) {
  return Arm({.urdf = folder / "arm.urdf",
              .package_paths = {{"berth_arm", folder}},
              .environment_links = {"table"}});
}

/// The one in data/bundled, loaded once.
inline const Arm& bundled_arm() {
  static const Arm arm = arm_of(BERTH_BUNDLED_ARM);
  return arm;
}

/// The same of fewer triangles.
inline const Arm& coarse_arm() {
  static const Arm arm = arm_of(testing::coarse_arm_folder(BERTH_BUNDLED_ARM));
  return arm;
}

/// As calibration would find it, were it perfect.
inline CalibrationResult true_result(const sim::DrawnCalibrationData& drawn) {
  CalibrationResult result;
  CameraCalibration& camera = result.cameras.emplace_back();
  camera.camera = drawn.camera->name;
  camera.X_PC = drawn.X_PC_true;
  camera.clock_offset_s = drawn.camera->clock_offset_s;
  return result;
}

}  // namespace berth
