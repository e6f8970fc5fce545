#pragma once

#include "lab/bench/drawn_scenes.hpp"
#include "lab/bench/timing.hpp"

namespace berth::lab {

/// How much is measured.
struct BenchExtent {
  int random_scenes = 0;
  int whole_robot_scenes = 0;
  /// Of them, for the peers that take seconds.
  int cameras_peer_scenes = 10;
  int hard_scenes = kHardScenes;
  int recorded_frames = 12;
  int stage_rounds = 20;
  RunLimits limits = {};
};

/// In less than half a minute.
inline constexpr BenchExtent kQuick{2, 1, 1, 1, 1, 1, {3, 5, 50}};

}  // namespace berth::lab
