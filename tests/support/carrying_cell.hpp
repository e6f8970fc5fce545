// A robot that carries a tool which its URDF does not have, in six poses, as a scene on disk.
#pragma once

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <string>

#include "berth/files/png.hpp"
#include "berth/render/robot_renderer.hpp"
#include "berth/robot/primitives.hpp"
#include "sim/carrying_robot.hpp"
#include "tests/support/cell_folder.hpp"

namespace berth::testing {

class CarryingCell : public CellFolder {
 public:
  /// `arm_folder` holds the bundled arm; `more` ends the scene file.
  explicit CarryingCell(const std::filesystem::path& arm_folder, bool carries = true,
                        std::size_t poses = 6, const std::string& more = "")
      : model(load_robot({.urdf = arm_folder / "arm.urdf",
                          .package_paths = {{"berth_arm", arm_folder}},
                          .environment_links = {"table"}})),
        drawn(sim::draw_carrying_robot(model, build_link_meshes(model), cell(carries, poses), 1)) {
    const CalibrationCamera& camera = *drawn.cameras[0];
    write_camera_info(camera.camera);
    write_joints(model, camera.frames);
    std::filesystem::create_directories(folder() / "cell/depth");
    for (const CalibrationFrame& frame : camera.frames) {
      write_depth_png(folder() / fmt::format("cell/depth/{:06}.png", frame.number), frame.depth_m,
                      0.001);
    }
    const Pose X_PC = sim::miscalibrated(camera.X_PC, 0.02, 0.03, 1);
    const Eigen::Quaterniond q(X_PC.linear());
    write("cell/scene.yaml",
          fmt::format("# Our cell.\nrobot:\n  urdf: {0}/arm.urdf\n"
                      "  package_paths: {{berth_arm: {0}}}\n  environment_links: [table]\n"
                      "cameras:\n  - name: camera\n    info: camera_info.yaml\n"
                      "    pose: {{parent: {1}, xyz: [{2}, {3}, {4}], "
                      "quaternion_xyzw: [{5}, {6}, {7}, {8}]}}\n"
                      "    depth: depth/*.png\njoints: joints.csv\n{9}",
                      arm_folder.string(), model.links.front().name, X_PC.translation().x(),
                      X_PC.translation().y(), X_PC.translation().z(), q.x(), q.y(), q.z(), q.w(),
                      more));
  }

  RobotModel model;
  sim::CarryingRobot drawn;

 private:
  static sim::CarryingRobotSettings cell(bool carries, std::size_t poses) {
    sim::CarryingRobotSettings settings;
    settings.positions = {
        {0.0, 0.6, 0.0, 1.2, 0.0, 0.9, 0.0},   {0.7, 0.3, 0.2, 1.5, 0.6, 0.5, 0.9},
        {-0.6, 0.5, 0.0, 1.0, -0.8, 1.2, 2.0}, {0.3, 0.9, -0.4, 1.4, 1.2, -0.6, -1.2},
        {-0.9, 0.2, 0.3, 1.8, 0.4, 0.2, -2.2}, {0.5, 0.0, -0.2, 1.7, -1.5, 1.0, 1.5}};
    settings.positions.resize(poses);
    settings.camera = {320, 240, 280, 280, 159.5, 119.5};
    const Eigen::Vector3d from(1.9, 0.3, 0.9);
    const Eigen::Vector3d z = (Eigen::Vector3d(0.2, 0, 0.5) - from).normalized();
    const Eigen::Vector3d x = z.cross(Eigen::Vector3d::UnitZ()).normalized();
    Pose X_BC = Pose::Identity();
    X_BC.linear() << x, z.cross(x), z;
    X_BC.translation() = from;
    settings.X_BC = {X_BC};
    settings.room = {{make_box({0.1, 6, 5}), Pose(Eigen::Translation3d(-1.5, 0, 1))},
                     {make_box({6, 6, 0.1}), Pose(Eigen::Translation3d(0, 0, -0.9))}};
    if (carries) {
      settings.carried = {{"tool", "arm_link_7", make_box({0.10, 0.06, 0.18}),
                           Pose(Eigen::Translation3d(0.02, 0, 0.23)), true}};
    }
    return settings;
  }
};

}  // namespace berth::testing
