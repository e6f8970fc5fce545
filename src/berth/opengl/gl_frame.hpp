#pragma once

#include "berth/opengl/gl_images.hpp"
#include "berth/pipeline/frame.hpp"

namespace berth {

/// A Frame whose images are on the GPU, in the context that was current when it was made.
struct GlFrame : Exposure {
  explicit GlFrame(const Camera& camera)
      : sensor_depth_m(GlPixel::depth_m, camera.width_px, camera.height_px),
        robot(camera.width_px, camera.height_px),
        obstacles(camera.width_px, camera.height_px) {}

  GlTexture sensor_depth_m;
  GlRobotImage robot;
  GlObstacleImage obstacles;
};

/// All of it in this program's memory, whose images `out` reuses.
void read_back(const GlFrame& frame, Frame& out);

}  // namespace berth
