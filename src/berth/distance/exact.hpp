#pragma once

#include "berth/distance/obstacle_tree.hpp"
#include "berth/distance/robot_tiles.hpp"
#include "berth/distance/settings.hpp"
#include "berth/types/camera.hpp"
#include "berth/types/link_distance.hpp"

namespace berth {

/// The memory of exact(), made once and used for every question; one for each thread. It carries
/// nothing from one answer to the next.
struct ExactWorkspace {
  /// A robot node, and a bound that its nearest tile of obstacles promises.
  struct NodeOrder {
    float bound_m2;
    int node;
  };

  RobotTiles robot;
  std::vector<NodeOrder> order;
};

/// The answer of brute_force, by branch and bound over an obstacle tree and the robot's tiles; of
/// several pairs equally close it may name another one.
///
/// The images have the camera's size. Link ids go from 1 to link_count; pixels of kEnvironmentLink
/// are not evaluated, any other id is a programming error. Fills everything but the mean direction
/// (see mean_direction.hpp). Allocates nothing once the workspace and `out` have grown to the
/// scene. Throws std::invalid_argument for bad settings.
void exact(const Camera& camera, const RobotImage& robot, const ObstacleTree& obstacles,
           int link_count, const DistanceSettings& settings, ExactWorkspace& workspace,
           LinkDistances& out);

}  // namespace berth
