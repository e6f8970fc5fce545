#pragma once

#include "thesis/opengl/gl_images.hpp"

namespace berth {

/// What a GlFrame holds on the GPU.
struct GlFrameImages {
  explicit GlFrameImages(const Camera& camera)
      : sensor_depth_m(GlPixel::depth_m, camera.width_px, camera.height_px),
        robot(camera.width_px, camera.height_px),
        obstacles(camera.width_px, camera.height_px) {}

  GlTexture sensor_depth_m;
  GlRobotImage robot;
  GlObstacleImage obstacles;
};

}  // namespace berth
