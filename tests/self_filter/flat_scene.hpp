#pragma once

#include "berth/self_filter/self_filter.hpp"

namespace berth {

/// A small camera with round figures: at 1 m a pixel is 10 mm wide.
inline constexpr int kSide_px = 60;
Camera flat_camera();

/// A robot and a sensor image made of rectangles that face the camera. The sensor sees the far wall
/// at first.
struct FlatScene {
  static constexpr float kWall_m = 3.0F;
  RobotImage robot;
  DepthImage sensor_depth_m;

  FlatScene();
  void add_link(LinkId id, const PixelRect& pixels, float depth_m);
  void see(const PixelRect& pixels, float depth_m);
};

/// Settings with every rule off.
SelfFilterSettings no_rules();

ObstacleImage filter(const FlatScene& scene, const SelfFilterSettings& settings);

}  // namespace berth
