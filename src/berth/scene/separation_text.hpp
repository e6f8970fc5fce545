#pragma once

#include <string>

#include "berth/scene/frame_result.hpp"

namespace berth {

/// What a monitor says, for people: its state, the scale of the speed, and why it is not larger.
/// Such as "reduced to 42 %: arm_link_5 is 0.310 m from what a camera sees; at 0.61 m/s it needs
/// 0.523 m". The result must have a separation.
std::string separation_text(const FrameResult& result);

}  // namespace berth
