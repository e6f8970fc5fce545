// The branch and bound of exact(), one link at a time.
#pragma once

#include <cstdint>

#include "berth/distance/closest_pair.hpp"
#include "berth/distance/exact.hpp"

namespace berth {

/// What is searched. `order` has room for as many entries as the robot has nodes.
struct SearchInput {
  const Metric& metric;
  const RobotTiles& robot;
  const ObstacleTree& obstacles;
  ExactWorkspace::NodeOrder* order;
};

/// Ascending bounds.
void sort_by_bound(ExactWorkspace::NodeOrder* order, int count);

/// Replaces `best` by the closest pair of the link whose list of nodes begins at last_node, where
/// that is closer. Returns the number of pair distances computed.
std::int64_t search_link(const SearchInput& input, int last_node, ClosestPair& best);

}  // namespace berth
