#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <vector>

#include "apps/view/page_message.hpp"
#include "berth/pipeline/frame_set.hpp"

namespace berth::app {

/// How the cameras see a cell's middle.
enum class CellSight : std::uint8_t {
  seen,    ///< free, or on a surface that a camera measured
  hidden,  ///< behind such a surface, and no camera sees it free
  unseen,  ///< no camera tells: outside of all images, without a reading, or behind the robot
};

/// Cells around the robot, in the root link's frame B; x runs fastest, then y, then z.
struct SpaceGrid {
  Eigen::Vector3d corner_m = Eigen::Vector3d::Zero();
  double edge_m = 0;
  std::array<int, 3> cells{};
  std::vector<CellSight> sight;
};

/// Where the links are, and so much around them.
Eigen::AlignedBox3d box_around(const RobotModel& model, const RobotPose& pose, double margin_m);

/// No more cells than kMostCells, none with an edge below kLeastEdge_m.
SpaceGrid find_space_grid(const FrameSet& frames, const Eigen::AlignedBox3d& box);
inline constexpr double kMostCells = 400'000;
inline constexpr double kLeastEdge_m = 0.02;

/// With one byte for each cell.
PageMessage space_message(const SpaceGrid& grid);

}  // namespace berth::app
