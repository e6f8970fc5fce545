#pragma once

#include <vector>

#include "berth/self_filter/settings.hpp"
#include "berth/types/camera.hpp"
#include "berth/types/image.hpp"
#include "berth/types/robot_image.hpp"

namespace berth {

/// The robot's silhouettes, grown: where a link ends against the background, or against a part of
/// the robot that lies deeper, its depth spreads over the pixels around. Infinity where nothing has
/// spread.
struct GrownRobot {
  /// By the link's metric padding, as a disc of that radius around each outline pixel at its depth.
  Image<float> padded_depth_m;
  /// By dilation_px pixels; without pixels where that is 0.
  Image<float> dilated_depth_m;
  /// Scratch: the half widths of a disc's rows, from its centre row outward.
  std::vector<int> half_width_px;
};

/// Only evaluated links grow; scenery does not. Reuses the memory of `out`.
void grow_robot(const Camera& camera, const RobotImage& robot, const SelfFilterSettings& settings,
                GrownRobot& out);

}  // namespace berth
