#pragma once

#include <vector>

#include "thesis/closest_pair.hpp"
#include "thesis/exact/robot_tiles.hpp"
#include "thesis/image_request.hpp"
#include "thesis/link_distance.hpp"

namespace berth {

/// The memory of exact(), made once and used for every request; one for each thread that asks. It
/// carries nothing from one answer to the next.
struct ExactWorkspace {
  /// A robot node, and a bound that its nearest tile of obstacles promises.
  struct NodeOrder {
    float bound_m2;
    int node;
  };
  /// One link's search, which may take several passes.
  struct LinkSearch {
    ClosestPair best;
    float lower_bound_m;
    bool is_done;
    std::int64_t pairs;
    /// Where its part of `order` begins.
    int first_order;
  };

  RobotTiles robot;
  std::vector<NodeOrder> order;
  std::vector<LinkSearch> links;
};

/// The answer of brute_force, found by branch and bound over the obstacles' tree and the robot's
/// tiles. Of several pairs equally close it may name another one. Links are searched side by side
/// on the threads that TBB has.
///
/// Fills everything but the mean direction (see mean_direction.hpp). With settings.tolerance_m or
/// deadline_us, lower_bound_m <= true distance <= distance_m holds for every link.
///
/// If `out` holds an answer on entry, its pixels are tried first in the new images. That saves time
/// where little has moved, and changes no distance. Allocates nothing once the workspace and `out`
/// have grown to the scene. Throws std::invalid_argument for bad settings.
void exact(const ImageRequest& request, ExactWorkspace& workspace, LinkDistances& out);

}  // namespace berth
