#include "sim/carrying_robot.hpp"

#include <fmt/format.h>

namespace berth::sim {
namespace {

/// What robot and obstacles are in one pose, seen by one camera.
DepthImage cast_pose(const RobotModel& carrying, const CarryingRobotSettings& settings,
                     std::size_t k, const Pose& X_BC) {
  RobotPose pose;
  forward_kinematics(carrying, settings.positions[k], pose);
  std::vector<PosedMesh> meshes;
  for (std::size_t i = 0; i < carrying.links.size(); ++i) {
    const Link& link = carrying.links[i];
    if (link.role != LinkRole::ignored && !link.mesh_L.empty()) {
      meshes.push_back({&link.mesh_L, pose.X_BL[i]});
    }
  }
  for (const DrawnObstacle& thing : settings.room) meshes.push_back({&thing.mesh_O, thing.X_BO});
  if (k < settings.in_pose.size()) {
    for (const DrawnObstacle& thing : settings.in_pose[k]) {
      meshes.push_back({&thing.mesh_O, thing.X_BO});
    }
  }
  return RayCaster(meshes, X_BC, settings.camera).cast_depth();
}

}  // namespace

CarryingRobot draw_carrying_robot(const RobotModel& model, std::shared_ptr<const LinkMeshes> meshes,
                                  const CarryingRobotSettings& settings, std::uint32_t seed) {
  RobotModel carrying = model;
  for (const Attachment& thing : settings.carried) carrying = with_attachment(carrying, thing);
  CarryingRobot drawn;
  drawn.calibration_data = {&model, std::move(meshes), nullptr, {}};
  for (std::size_t c = 0; c < settings.X_BC.size(); ++c) {
    auto camera = std::make_unique<CalibrationCamera>();
    camera->name = fmt::format("camera {}", c + 1);
    camera->camera = settings.camera;
    camera->X_PC = settings.X_BC[c];
    for (std::size_t k = 0; k < settings.positions.size(); ++k) {
      DepthImage depth_m = cast_pose(carrying, settings, k, settings.X_BC[c]);
      const auto number = static_cast<std::uint32_t>(c * settings.positions.size() + k);
      add_errors(settings.errors, seed + 10 * number, depth_m);
      camera->frames.push_back({static_cast<int>(k),
                                std::move(depth_m),
                                {static_cast<double>(k), settings.positions[k]}});
    }
    CameraCalibration& found = drawn.found.cameras.emplace_back();
    found.camera = camera->name;
    found.X_PC = camera->X_PC;
    drawn.calibration_data.cameras.push_back(camera.get());
    drawn.cameras.push_back(std::move(camera));
  }
  return drawn;
}

}  // namespace berth::sim
