// Inside self_filter/ only.
#pragma once

#include <cstdint>
#include <vector>

#include "berth/self_filter/grown_robot.hpp"

namespace berth {

/// Where padding of flying_patch_radius_m would reach. Found tile by tile, when it is asked for:
/// few tiles have obstacles that hang on the robot.
class Neighbourhood {
 public:
  /// As GrownRobot::begin, which says what the discs are.
  void begin(const Camera& camera, const RobotImage& robot, const SelfFilterSettings& settings,
             const Outline& outline);

  /// Whether this obstacle lies in it. From begin() on, the obstacles of a tile stay the same until
  /// one of them is asked for.
  bool holds(Pixel p, DepthView sensor_depth_m, const Image<PixelFate>& fate);

 private:
  void make_discs();

  GrownRobot grown_;
  const Outline* outline_ = nullptr;
  TileGrid grid_;
  bool has_discs_ = false;
  /// Of each tile, whether it was found, and which of its obstacles lie in it.
  std::vector<std::uint8_t> is_found_;
  std::vector<TileBits> near_;
};

}  // namespace berth
