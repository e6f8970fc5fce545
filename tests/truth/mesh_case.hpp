// Random requests to the method `mesh`: a drawn scene, what sensors and filters do to it, and what
// is asked.
#pragma once

#include "berth/robot/kinematics.hpp"
#include "sim/drawn_views.hpp"

namespace berth::sim {

struct MeshCase {
  std::vector<DrawnView> views;
  /// Where the robot is when it is asked for: not always where it was seen.
  RobotPose pose;
  SpaceSettings settings;
};

/// One to four cameras of 160 x 120 to 320 x 240 px at most; in part with noise, missing readings,
/// fates of all kinds, calibration errors, ages, other settings.
MeshCase draw_mesh_case(const RobotModel& model, const std::vector<MeshTree>& link_trees,
                        std::uint32_t seed);

/// The same views, unchanged, with the default settings.
MeshCase plain_mesh_case(const DrawnViews& drawn);

}  // namespace berth::sim
