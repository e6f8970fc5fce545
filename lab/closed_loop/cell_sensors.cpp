#include "lab/closed_loop/cell_sensors.hpp"

#include "sim/sensor_model.hpp"

namespace berth::lab {
namespace {

constexpr sim::SensorErrors kErrors{
    .step_m_at_1m = 0.0029, .noise_m_at_1m = 0.0015, .dropout_share = 0.01, .mixed_share = 0.1};

/// 6 degrees.
constexpr double kBumped_rad = 0.105;

/// Those with a mesh that a joint moves, or all others.
std::vector<std::size_t> links_with_mesh(const RobotModel& model, bool is_moved) {
  std::vector<std::size_t> links;
  for (std::size_t i = 0; i < model.links.size(); ++i) {
    if (!model.links[i].mesh_L.empty() && model.is_moved(i) == is_moved) links.push_back(i);
  }
  return links;
}

std::vector<TriangleMesh> meshes_of(const RobotModel& model, bool is_moved,
                                    const std::vector<TriangleMesh>& visitors = {}) {
  std::vector<TriangleMesh> meshes;
  for (const std::size_t link : links_with_mesh(model, is_moved)) {
    meshes.push_back(model.links[link].mesh_L);
  }
  meshes.insert(meshes.end(), visitors.begin(), visitors.end());
  return meshes;
}

std::vector<Pose> poses_of(const std::vector<std::size_t>& links, const RobotPose& pose) {
  std::vector<Pose> X_BL;
  for (const std::size_t link : links) X_BL.push_back(pose.X_BL[link]);
  return X_BL;
}

}  // namespace

CellSensors::CellSensors(const RobotModel& model, const std::vector<TriangleMesh>& visitors,
                         std::uint32_t seed)
    : cameras_(cell_cameras()),
      links_(links_with_mesh(model, true)),
      still_(meshes_of(model, false)),
      still_m_(cameras_.size()),
      caster_(meshes_of(model, true, visitors)),
      seed_(seed) {
  RobotPose pose;
  forward_kinematics(model, std::vector<double>(model.joints.size()), pose);
  X_BS_ = poses_of(links_with_mesh(model, false), pose);
}

DepthImage CellSensors::take_image(int camera, const RobotPose& pose, const std::vector<Pose>& X_BP,
                                   bool is_turned) {
  const CellCamera& cell_camera = cameras_[camera];
  Pose X_BC = cell_camera.X_BC;
  if (is_turned) X_BC = X_BC * Eigen::AngleAxisd(kBumped_rad, Eigen::Vector3d::UnitY());
  DepthImage& still_m = still_m_[camera][is_turned];
  if (still_m.width() == 0) still_m = still_.cast(cell_camera.camera, X_BC, X_BS_);
  std::vector<Pose> X_BM = poses_of(links_, pose);
  X_BM.insert(X_BM.end(), X_BP.begin(), X_BP.end());
  DepthImage depth_m = still_m;
  caster_.cast_before(cell_camera.camera, X_BC, X_BM, depth_m);
  sim::add_errors_quickly(kErrors, ++seed_, depth_m);
  return depth_m;
}

}  // namespace berth::lab
