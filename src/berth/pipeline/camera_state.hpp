#pragma once

#include "berth/pipeline/frame.hpp"
#include "berth/pipeline/timeliness.hpp"
#include "berth/types/status.hpp"

namespace berth {

/// What becomes of one camera at `now_s`, but for whether it is blind.
CameraState camera_state(const Exposure& exposure, double now_s, const TimeSettings& settings);

/// The same. `frame` is its newest one, or null where it has none yet.
CameraState camera_state(const Frame* frame, double now_s, const TimeSettings& settings);

}  // namespace berth
