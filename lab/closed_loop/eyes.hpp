// The depth cameras of the cell.
#pragma once

#include <cstdint>
#include <vector>

#include "berth/robot/kinematics.hpp"
#include "lab/closed_loop/cell.hpp"
#include "lab/closed_loop/depth_caster.hpp"

namespace berth::lab {

/// Ray cast images of arm, cell and person, with the faults of a stereo camera: steps of disparity,
/// noise that grows with z^2, mixed pixels at outlines, single pixels without a reading.
class Eyes {
 public:
  /// `model` and its meshes are copied.
  Eyes(const RobotModel& model, std::uint32_t seed);

  /// By the camera's place in cell_cameras().
  DepthImage look(int camera, const RobotPose& pose, const std::vector<Pose>& X_BP);

 private:
  std::vector<CellCamera> cameras_;
  /// Those of the model that have a mesh.
  std::vector<std::size_t> links_;
  DepthCaster caster_;
  std::uint32_t seed_;
};

}  // namespace berth::lab
