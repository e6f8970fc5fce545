#include "lab/closed_loop/cell_sensors.hpp"

#include "sim/person.hpp"
#include "sim/sensor_model.hpp"

namespace berth::lab {
namespace {

constexpr sim::SensorErrors kErrors{
    .step_m_at_1m = 0.0029, .noise_m_at_1m = 0.0015, .dropout_share = 0.01, .mixed_share = 0.1};

std::vector<std::size_t> links_with_mesh(const RobotModel& model) {
  std::vector<std::size_t> links;
  for (std::size_t i = 0; i < model.links.size(); ++i) {
    if (!model.links[i].mesh_L.empty()) links.push_back(i);
  }
  return links;
}

std::vector<TriangleMesh> all_meshes(const RobotModel& model) {
  std::vector<TriangleMesh> meshes;
  for (const std::size_t link : links_with_mesh(model)) meshes.push_back(model.links[link].mesh_L);
  for (TriangleMesh& part : sim::make_person_meshes()) meshes.push_back(std::move(part));
  return meshes;
}

}  // namespace

CellSensors::CellSensors(const RobotModel& model, std::uint32_t seed)
    : cameras_(cell_cameras()),
      links_(links_with_mesh(model)),
      caster_(all_meshes(model)),
      seed_(seed) {}

DepthImage CellSensors::take_image(int camera, const RobotPose& pose,
                                   const std::vector<Pose>& X_BP) {
  std::vector<Pose> X_BM;
  for (const std::size_t link : links_) X_BM.push_back(pose.X_BL[link]);
  X_BM.insert(X_BM.end(), X_BP.begin(), X_BP.end());
  const CellCamera& cell_camera = cameras_[camera];
  DepthImage depth_m = caster_.cast(cell_camera.camera, cell_camera.X_BC, X_BM);
  sim::add_errors_quickly(kErrors, ++seed_, depth_m);
  return depth_m;
}

}  // namespace berth::lab
