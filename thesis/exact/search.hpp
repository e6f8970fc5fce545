// The branch and bound of exact(), one link at a time.
#pragma once

#include <chrono>
#include <cstdint>
#include <limits>

#include "thesis/closest_pair.hpp"
#include "thesis/exact/exact.hpp"

namespace berth {

/// The input of a search. `order` has room for as many entries as the link has nodes.
struct SearchInput {
  const Metric& metric;
  const RobotTiles& robot;
  DepthView robot_depth_m;
  const ObstacleTree& obstacles;
  DepthView obstacle_depth_m;
  ExactWorkspace::NodeOrder* order;
};

/// When a search may end before it knows the answer.
struct SearchLimits {
  /// As soon as no pair can be closer than the best one by more than this.
  float tolerance_m = 0;
  /// At this time; but never before a first pair, or the first look for one.
  std::chrono::steady_clock::time_point deadline = std::chrono::steady_clock::time_point::max();
  /// A robot node whose search takes more work than this, counted about in pairs, is looked at
  /// along its closest pair and its surface.
  std::int64_t most_work_unaligned = 12000;
};

/// What a search found out besides the pair.
struct SearchResult {
  /// No pair is closer than this.
  float lower_bound_m = 0;
  /// Whether it got as far as the tolerance.
  bool complete = false;
  /// Pair distances computed.
  std::int64_t pairs = 0;
};

/// Ascending bounds.
void sort_by_bound(ExactWorkspace::NodeOrder* order, int count);

/// Replaces `best` by the closest pair of the link whose list of nodes begins at last_node, where
/// that is closer. `best` is a pair of the link, or no_pair_within() of the range.
SearchResult search_link(const SearchInput& input, int last_node, const SearchLimits& limits,
                         ClosestPair& best);

}  // namespace berth
