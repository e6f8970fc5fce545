#pragma once

#include "lab/bench/peer.hpp"

namespace berth::lab {

/// How long one method is measured on one scene, after a first run to warm up: until enough_ms have
/// passed, but no more than max_runs. A first run that takes longer than once_above_ms is the
/// measurement.
struct RunLimits {
  int max_runs = 15;
  double enough_ms = 30;
  double once_above_ms = 100;
};

/// Medians of the runs: of a method with one thread processor time, which another program on the
/// machine lengthens least; of one with more, by the clock on the wall.
struct PeerTime {
  double build_ms;
  /// With the build.
  double total_ms;
};

/// Leaves the answer of the last run in distances_m.
PeerTime time_peer(Peer& peer, const BenchScene& scene, const RunLimits& limits,
                   PeerDistances& distances_m);

}  // namespace berth::lab
