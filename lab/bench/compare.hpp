#pragma once

#include "lab/bench/bench_scene.hpp"
#include "lab/bench/peer.hpp"
#include "lab/bench/table.hpp"
#include "lab/bench/timing.hpp"

namespace berth::lab {

/// The peers, brute force and the reader on all scenes, in one table: the time of a scene is the
/// median of its runs, and the columns are over the scenes. Errors are those against brute force.
Table compare_peers(const SceneSet& scenes, const RunLimits& limits,
                    const std::vector<std::unique_ptr<Peer>>& peers);

}  // namespace berth::lab
