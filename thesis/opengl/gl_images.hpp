// The images of one request on the GPU, and their way there and back.
#pragma once

#include "berth/types/image.hpp"
#include "berth/types/obstacle_image.hpp"
#include "berth/types/robot_image.hpp"
#include "thesis/opengl/gl_buffer.hpp"
#include "thesis/opengl/gl_texture.hpp"

namespace berth {

/// R and I. A depth is 0, not NaN, where there is none: GLSL does not promise NaN.
struct GlRobotImage {
  GlRobotImage() = default;
  GlRobotImage(int width, int height)
      : depth_m(GlPixel::depth_m, width, height), link_id(GlPixel::link_id, width, height) {}

  GlTexture depth_m;
  GlTexture link_id;
};

/// F, 0 where there is nothing, and each pixel's PixelFate as a number.
struct GlObstacleImage {
  GlObstacleImage() = default;
  GlObstacleImage(int width, int height)
      : depth_m(GlPixel::depth_m, width, height), fate(GlPixel::bits, width, height) {}

  GlTexture depth_m;
  GlTexture fate;
};

/// Carries images of one size to the GPU.
class GlUpload {
 public:
  GlUpload(int width, int height);

  /// The image has the texture's size and this one's.
  void send(DepthView depth_m, const GlTexture& texture);
  void send(const RobotImage& robot, const GlRobotImage& texture);
  void send(const Image<PixelFate>& fate, const GlTexture& texture);

 private:
  template <class T, class U, class Convert>
  void send_rows(const ImageView<T>& image, const GlTexture& texture, Convert convert, U* staging);

  GlBuffer staging_;
  GlFence sent_;
};

/// The images of one request, and what carries them.
struct GlUploadedImages {
  GlUploadedImages(int width, int height)
      : upload(width, height),
        robot(width, height),
        obstacle_depth_m(GlPixel::depth_m, width, height) {}

  bool has_size(int width, int height) const {
    return obstacle_depth_m.width() == width && obstacle_depth_m.height() == height;
  }

  GlUpload upload;
  GlRobotImage robot;
  GlTexture obstacle_depth_m;
};

/// The texture's pixels, once the GPU has made them; NaN where there is no depth. Reuses the
/// images' memory.
void read_back(const GlTexture& depth_m, DepthImage& out);
void read_back(const GlRobotImage& robot, RobotImage& out);
/// Counts the fates, too.
void read_back(const GlObstacleImage& obstacles, ObstacleImage& out);
/// The fates alone.
void read_back(const GlTexture& fates, ObstacleImage& out);

}  // namespace berth
