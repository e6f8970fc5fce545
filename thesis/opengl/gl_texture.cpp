#include "thesis/opengl/gl_texture.hpp"

#include <epoxy/gl.h>

#include <cassert>

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

GLenum client_format_of(GlPixel pixel) {
  return pixel == GlPixel::depth_m ? GL_RED : GL_RED_INTEGER;
}

GLenum client_type_of(GlPixel pixel) {
  return pixel == GlPixel::depth_m ? GL_FLOAT : GL_UNSIGNED_INT;
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

void GlTexture::clear() const {
  glClearTexImage(name_, 0, client_format_of(pixel_), client_type_of(pixel_), nullptr);
}

void GlTexture::copy_to(const GlTexture& target) const {
  assert(pixel_ == target.pixel_ && width_ == target.width_ && height_ == target.height_);
  glCopyImageSubData(name_, GL_TEXTURE_2D, 0, 0, 0, 0, target.name_, GL_TEXTURE_2D, 0, 0, 0, 0,
                     width_, height_, 1);
}

}  // namespace berth
