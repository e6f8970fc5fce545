#pragma once

#include "lab/bench/recorded_scenes.hpp"
#include "lab/bench/table.hpp"

namespace berth::lab {

/// The way from the depth image to the distances in the current OpenGL context: its stages one by
/// one, each until the GPU has done it, and the whole of it with each method. Every frame of the
/// recording but no more than `max_frames`, `rounds` times after one to warm up, by the clock on
/// the wall; times go over all runs.
Table measure_gl_stages(const Recording& recording, int max_frames, int rounds);

}  // namespace berth::lab
