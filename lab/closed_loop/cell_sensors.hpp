#pragma once

#include <cstdint>
#include <vector>

#include "berth/robot/kinematics.hpp"
#include "lab/closed_loop/cell.hpp"
#include "sim/moving_ray_caster.hpp"

namespace berth::lab {

/// The cell's depth cameras: ray cast images of arm, cell and person, with the errors of a stereo
/// camera.
class CellSensors {
 public:
  /// `model` and its meshes are copied.
  CellSensors(const RobotModel& model, std::uint32_t seed);

  /// By the camera's place in cell_cameras().
  DepthImage take_image(int camera, const RobotPose& pose, const std::vector<Pose>& X_BP);

 private:
  std::vector<CellCamera> cameras_;
  /// Those of the model that have a mesh.
  std::vector<std::size_t> links_;
  sim::MovingRayCaster caster_;
  std::uint32_t seed_;
};

}  // namespace berth::lab
