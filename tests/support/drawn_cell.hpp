// The bundled arm, drawn as it goes through poses, as a scene on disk.
#pragma once

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <string>

#include "berth/files/png.hpp"
#include "berth/render/robot_renderer.hpp"
#include "sim/drawn_calibration_data.hpp"
#include "sim/sensor_model.hpp"
#include "tests/support/cell_folder.hpp"

namespace berth::testing {

/// What the scene file of a DrawnCell says.
struct CellLines {
  /// How far the camera's pose in it is from the truth.
  double offset_m = 0.05;
  double angle_rad = 0.09;
  /// Images of readings in these units, which are those less this.
  double depth_scale_m = 0.001;
  double depth_offset_m = 0;
  std::string more = "";
};

class DrawnCell : public CellFolder {
 public:
  /// `arm_folder` holds the bundled arm.
  DrawnCell(const std::filesystem::path& arm_folder, const sim::DrawnCalibrationSettings& settings,
            std::uint32_t seed, const CellLines& lines = {})
      : model(load_robot({.urdf = arm_folder / "arm.urdf",
                          .package_paths = {{"berth_arm", arm_folder}},
                          .environment_links = {"table"}})),
        drawn(sim::draw_calibration_data(model, build_link_meshes(model), settings, seed)) {
    write_camera_info(drawn.camera->camera);
    write_joints(model, drawn.camera->frames);
    std::filesystem::create_directories(folder() / "cell/depth");
    for (std::size_t f = 0; f < drawn.camera->frames.size(); ++f) {
      DepthImage raw = drawn.camera->frames[f].depth_m;
      for (float& z_m : raw.pixels()) z_m -= static_cast<float>(lines.depth_offset_m);
      write_depth_png(folder() / fmt::format("cell/depth/{:06}.png", f), raw, lines.depth_scale_m);
    }
    write("cell/scene.yaml", scene_text(arm_folder, lines, seed));
  }

  RobotModel model;
  sim::DrawnCalibrationData drawn;

 private:
  std::string scene_text(const std::filesystem::path& arm_folder, const CellLines& lines,
                         std::uint32_t seed) const {
    const Pose X_PC = sim::miscalibrated(drawn.X_PC_true, lines.offset_m, lines.angle_rad, seed);
    const Eigen::Vector3d p = X_PC.translation();
    const Eigen::Quaterniond q(X_PC.linear());
    return fmt::format(
        "# Our cell.\n"
        "robot:\n  urdf: {0}/arm.urdf\n  package_paths: {{berth_arm: {0}}}\n"
        "  environment_links: [table]\n"
        "cameras:\n"
        "  - name: camera  # above the door\n"
        "    info: camera_info.yaml\n"
        "    pose: {{parent: {1}, xyz: [{2}, {3}, {4}], quaternion_xyzw: [{5}, {6}, {7}, {8}]}}\n"
        "    depth: depth/*.png\n"
        "    depth_scale: {9}  # as its driver says\n"
        "    depth_offset_m: {10}\n"
        "joints: joints.csv\n"
        "evaluation: {{range_m: 1}}\n{11}",
        arm_folder.string(), model.links[drawn.camera->parent].name, p.x(), p.y(), p.z(), q.x(),
        q.y(), q.z(), q.w(), lines.depth_scale_m, lines.depth_offset_m, lines.more);
  }
};

}  // namespace berth::testing
