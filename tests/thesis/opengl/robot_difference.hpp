#pragma once

#include <vector>

#include "berth/types/robot_image.hpp"

namespace berth {

/// Depths of pixels that see the same triangle differ by less than this share of themselves.
inline constexpr double kDepthError = 1e-5;

/// How the GPU's image of a robot differs from the CPU's.
struct RobotDifference {
  int robot_pixels = 0;
  /// Within a pixel of a link's end, a step in depth or a crease, where rounding decides what a
  /// pixel's centre meets.
  int at_edges = 0;
  /// Another id, or a depth that is off by more than kDepthError of itself.
  std::vector<Pixel> wrong;
  /// The greatest error of a depth, as a share of it, where no edge is.
  double depth_error = 0;

  double edge_share() const { return robot_pixels > 0 ? double(at_edges) / robot_pixels : 0; }
};

RobotDifference difference(const RobotImage& gpu, const RobotImage& cpu);

}  // namespace berth
