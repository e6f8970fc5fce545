#pragma once

#include <array>
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
  /// `model` and all meshes are copied; `visitors` are what comes near the arm.
  CellSensors(const RobotModel& model, const std::vector<TriangleMesh>& visitors,
              std::uint32_t seed);

  /// By the camera's place in cell_cameras().
  /// With is_turned by somebody who bumped into it.
  DepthImage take_image(int camera, const RobotPose& pose, const std::vector<Pose>& X_BP,
                        bool is_turned = false);

 private:
  std::vector<CellCamera> cameras_;
  /// Those that a joint moves.
  std::vector<std::size_t> links_;
  /// What stands still, and its images that were asked for: of each camera where it is, and bumped.
  sim::MovingRayCaster still_;
  std::vector<Pose> X_BS_;
  std::vector<std::array<DepthImage, 2>> still_m_;
  sim::MovingRayCaster caster_;
  std::uint32_t seed_;
};

}  // namespace berth::lab
