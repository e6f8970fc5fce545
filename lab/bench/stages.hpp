#pragma once

#include "lab/bench/recorded_scenes.hpp"
#include "lab/bench/table.hpp"

namespace berth::lab {

/// The pipeline stage by stage, the whole way, and a request at other joint angles, with `threads`
/// threads, and rendering by Embree's rays beside it: every frame of the recording, `rounds` times
/// after one to warm up. The columns are over all runs.
Table measure_stages(const Recording& recording, int threads, int rounds);

}  // namespace berth::lab
