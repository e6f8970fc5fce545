// Inside self_filter/ only.
#pragma once

#include <vector>

#include "berth/self_filter/tolerance.hpp"
#include "berth/types/obstacle_image.hpp"
#include "berth/types/robot_image.hpp"

namespace berth {

/// Appends the obstacles that the robot's own readings lead to, and the pixels between. Own are the
/// readings on the model's surface: fate `robot`, and not behind it by more than the tolerance.
/// They lead to a pixel beside it by steps to neighbours (8) that are joined (joined.hpp), from
/// pixel to pixel of what was dropped there as `padding`. What stands behind the
/// robot, or before it, is a step away from its readings. `is_found` is 0 everywhere, before and
/// after.
void append_seam(DepthView sensor_depth_m, const RobotImage& robot, const Tolerance& tolerance,
                 const Image<PixelFate>& fate, Image<std::uint8_t>& is_found,
                 std::vector<Pixel>& seam);

}  // namespace berth
