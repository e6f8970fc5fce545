#pragma once

#include <memory>

#include "lab/bench/bench_scene.hpp"
#include "lab/measure/recording.hpp"

namespace berth::lab {

/// Up to max_count of its frames, spread over the recording, after berth's own self filter.
SceneSet recorded_scenes(std::shared_ptr<const Recording> recording, int max_count);

}  // namespace berth::lab
