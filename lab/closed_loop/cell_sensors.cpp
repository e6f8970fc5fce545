#include "lab/closed_loop/cell_sensors.hpp"

#include "sim/sensor_model.hpp"

namespace berth::lab {
namespace {

constexpr sim::SensorErrors kErrors{
    .step_m_at_1m = 0.0029, .noise_m_at_1m = 0.0015, .dropout_share = 0.01, .mixed_share = 0.1};

/// 6 degrees.
constexpr double kBumped_rad = 0.105;

std::vector<std::size_t> links_with_mesh(const RobotModel& model) {
  std::vector<std::size_t> links;
  for (std::size_t i = 0; i < model.links.size(); ++i) {
    if (!model.links[i].mesh_L.empty()) links.push_back(i);
  }
  return links;
}

std::vector<TriangleMesh> all_meshes(const RobotModel& model,
                                     const std::vector<TriangleMesh>& visitors) {
  std::vector<TriangleMesh> meshes;
  for (const std::size_t link : links_with_mesh(model)) meshes.push_back(model.links[link].mesh_L);
  meshes.insert(meshes.end(), visitors.begin(), visitors.end());
  return meshes;
}

}  // namespace

CellSensors::CellSensors(const RobotModel& model, const std::vector<TriangleMesh>& visitors,
                         std::uint32_t seed)
    : cameras_(cell_cameras()),
      links_(links_with_mesh(model)),
      caster_(all_meshes(model, visitors)),
      seed_(seed) {}

DepthImage CellSensors::take_image(int camera, const RobotPose& pose, const std::vector<Pose>& X_BP,
                                   bool is_turned) {
  std::vector<Pose> X_BM;
  for (const std::size_t link : links_) X_BM.push_back(pose.X_BL[link]);
  X_BM.insert(X_BM.end(), X_BP.begin(), X_BP.end());
  const CellCamera& cell_camera = cameras_[camera];
  Pose X_BC = cell_camera.X_BC;
  if (is_turned) X_BC = X_BC * Eigen::AngleAxisd(kBumped_rad, Eigen::Vector3d::UnitY());
  DepthImage depth_m = caster_.cast(cell_camera.camera, X_BC, X_BM);
  sim::add_errors_quickly(kErrors, ++seed_, depth_m);
  return depth_m;
}

}  // namespace berth::lab
