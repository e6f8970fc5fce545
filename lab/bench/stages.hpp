#pragma once

#include "lab/bench/recorded_scenes.hpp"
#include "lab/bench/table.hpp"

namespace berth::lab {

/// The pipeline stage by stage, the whole way, and a request at other joint angles, with `threads`
/// threads, and rendering by Embree's rays beside it: every frame of the recording, `rounds` times
/// after one to warm up. The columns are over all runs.
Table measure_stages(const Recording& recording, int threads, int rounds);

/// The way from the depth image to the distances in the current OpenGL context: its stages one by
/// one, each until the GPU has done it, and the whole of it with each method. Every frame of the
/// recording but no more than `max_frames`, `rounds` times after one to warm up, by the clock on
/// the wall; times go over all runs.
Table measure_gl_stages(const Recording& recording, int max_frames, int rounds);

}  // namespace berth::lab
