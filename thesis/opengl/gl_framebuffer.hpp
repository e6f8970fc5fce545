#pragma once

#include <initializer_list>

#include "thesis/opengl/gl_texture.hpp"

namespace berth {

/// What draw calls draw on: textures of one size, and a depth buffer of floats in which the nearer
/// surface has the greater number, 0 where nothing is.
class GlFramebuffer {
 public:
  GlFramebuffer(int width, int height);
  ~GlFramebuffer();
  GlFramebuffer(const GlFramebuffer&) = delete;
  GlFramebuffer& operator=(const GlFramebuffer&) = delete;

  /// Draw calls from now on: a fragment shader's output i goes to target i, where its surface is
  /// nearer than what is there, and of equals to the first. Clears the depth buffer. The targets
  /// have this one's size. Throws std::runtime_error if the driver cannot draw on them.
  void begin(std::initializer_list<const GlTexture*> targets);

 private:
  int width_;
  int height_;
  unsigned name_ = 0;
  unsigned depth_ = 0;
};

}  // namespace berth
