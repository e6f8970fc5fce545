// Robots that teach-in is tested with.
#pragma once

#include <filesystem>

#include "berth/calibration/calibrate.hpp"
#include "tests/support/drawn_teach_in.hpp"

namespace berth {

struct Arm {
  RobotModel model;
  std::shared_ptr<const LinkMeshes> meshes;

  explicit Arm(const RobotSettings& settings)
      : model(load_robot(settings)), meshes(build_link_meshes(model)) {}

  testing::DrawnTeachIn draw(const testing::DrawnTeachInSettings& settings,
                             std::uint32_t seed) const {
    return testing::draw_teach_in(model, meshes, settings, seed);
  }
};

/// The one in data/bundled, loaded once.
inline const Arm& bundled_arm() {
  static const std::filesystem::path folder = BERTH_BUNDLED_ARM;
  static const Arm arm({.urdf = folder / "arm.urdf",
                        .package_paths = {{"berth_arm", folder}},
                        .environment_links = {"table"}});
  return arm;
}

/// As teach-in would find it, were it perfect.
inline CalibrationResult true_result(const testing::DrawnTeachIn& drawn) {
  CalibrationResult result;
  CameraCalibration& camera = result.cameras.emplace_back();
  camera.camera = drawn.camera->name;
  camera.X_PC = drawn.X_PC_true;
  camera.clock_offset_s = drawn.camera->clock_offset_s;
  return result;
}

}  // namespace berth
