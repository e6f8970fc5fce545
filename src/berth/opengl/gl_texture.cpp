#include "berth/opengl/gl_texture.hpp"

#include <epoxy/gl.h>

namespace berth {
namespace {

GLenum format_of(GlPixel pixel) {
  switch (pixel) {
    case GlPixel::depth_m:
      return GL_R32F;
    case GlPixel::link_id:
      return GL_R16UI;
    case GlPixel::bits:
      return GL_R32UI;
  }
  return GL_NONE;
}

}  // namespace

GlTexture::GlTexture(GlPixel pixel, int width, int height)
    : pixel_(pixel), width_(width), height_(height) {
  glCreateTextures(GL_TEXTURE_2D, 1, &name_);
  glTextureStorage2D(name_, 1, format_of(pixel), width, height);
  glTextureParameteri(name_, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
  glTextureParameteri(name_, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
}

GlTexture::~GlTexture() {
  if (name_ != 0) glDeleteTextures(1, &name_);
}

}  // namespace berth
