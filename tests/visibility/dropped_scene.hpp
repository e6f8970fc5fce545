// Readings of a random image that a self filter dropped as rejected.
#pragma once

#include <cmath>

#include "sim/random_images.hpp"

namespace berth::testing {

inline constexpr int kDroppedWidth_px = 96, kDroppedHeight_px = 72, kDroppedLinks = 4;

/// A request, and what its self filter dropped as rejected: blocks of obstacle pixels at random.
struct DroppedScene {
  sim::ImagePair images;
  DepthImage sensor_depth_m;
  ObstacleImage obstacles;
};

inline DroppedScene dropped_scene(std::uint32_t seed) {
  DroppedScene scene{
      sim::random_images(seed, kDroppedWidth_px, kDroppedHeight_px, kDroppedLinks), {}, {}};
  scene.sensor_depth_m = scene.images.obstacle_depth_m;
  scene.obstacles.depth_m = scene.images.obstacle_depth_m;
  scene.obstacles.fate.resize(kDroppedWidth_px, kDroppedHeight_px, PixelFate::obstacle);
  for (int v = 0; v < kDroppedHeight_px; ++v) {
    for (int u = 0; u < kDroppedWidth_px; ++u) {
      const std::uint32_t block = (u / 6 * 7919 + v / 6 * 104729 + seed * 31) % 17;
      PixelFate& fate = scene.obstacles.fate(u, v);
      if (std::isnan(scene.sensor_depth_m(u, v))) {
        fate = PixelFate::no_reading;
      } else if (block < 8) {
        fate = block < 3   ? PixelFate::flying_patch
               : block < 6 ? PixelFate::speckle
                           : PixelFate::soft;
        scene.obstacles.depth_m(u, v) = kNoDepth;
      } else if (block == 8) {
        fate = PixelFate::padding;
        scene.obstacles.depth_m(u, v) = kNoDepth;
      }
      ++scene.obstacles.count[static_cast<std::size_t>(fate)];
    }
  }
  return scene;
}

}  // namespace berth::testing
