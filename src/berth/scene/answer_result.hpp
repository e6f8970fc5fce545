#pragma once

#include "berth/pipeline/answer.hpp"
#include "berth/pipeline/robot.hpp"
#include "berth/scene/frame_result.hpp"

namespace berth {

/// An answer as a result, but for which frame it is of, and the cameras. It refers to the answer.
FrameResult result_of(const Robot& robot, const Answer& answer);

}  // namespace berth
