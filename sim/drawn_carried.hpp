// Drawn tools and cable boxes, and cells in which a robot carries them.
#pragma once

#include <cstdint>
#include <vector>

#include "sim/carrying_robot.hpp"

namespace berth::sim {

/// A thing that is carried, as boxes that overlap, in the frame L of its link.
struct DrawnThing {
  struct Piece {
    Pose X_LP = Pose::Identity();
    Eigen::Vector3d size_m = Eigen::Vector3d::Zero();
  };
  std::size_t link = 0;
  std::vector<Piece> pieces;

  TriangleMesh mesh_L() const;
  /// 0 inside.
  double distance_m(const Eigen::Vector3d& p_L_m) const;
};

enum class DrawnKind {
  tool,       ///< a box at the tip
  bent_tool,  ///< two boxes at the tip that make an L
  cable_box,  ///< a box beside a link half the way up
  bare,       ///< nothing
};

struct DrawnCarryingCell {
  /// No piece: the robot carries nothing.
  DrawnThing thing;
  CarryingRobotSettings settings;
};

/// A robot in `poses` poses before `cameras` cameras, in a room with things beside it, some of
/// which stand 1 cm and more from it in all poses. Depends on its arguments alone. Throws
/// std::runtime_error where no camera sees the robot.
DrawnCarryingCell draw_carrying_cell(const RobotModel& model, DrawnKind kind, int poses,
                                     int cameras, std::uint32_t seed);

}  // namespace berth::sim
