#include "thesis/opengl/gl_images.hpp"

#include <epoxy/gl.h>

#include <cassert>
#include <cmath>
#include <type_traits>

namespace berth {
namespace {

/// The type of a pixel in this program's memory.
GLenum type_of(GlPixel pixel) {
  if (pixel == GlPixel::depth_m) return GL_FLOAT;
  return pixel == GlPixel::bits ? GL_UNSIGNED_BYTE : GL_UNSIGNED_SHORT;
}

/// The type of what a pixel is read back as.
template <class T>
constexpr GLenum type_of_copy() {
  if constexpr (std::is_same_v<T, float>) return GL_FLOAT;
  return sizeof(T) == 1 ? GL_UNSIGNED_BYTE : GL_UNSIGNED_SHORT;
}

GLenum copied_format_of(GlPixel pixel) {
  return pixel == GlPixel::depth_m ? GL_RED : GL_RED_INTEGER;
}

template <class T>
void get_pixels(const GlTexture& texture, Image<T>& out) {
  out.resize(texture.width(), texture.height(), T{});
  glMemoryBarrier(GL_TEXTURE_UPDATE_BARRIER_BIT);
  glPixelStorei(GL_PACK_ALIGNMENT, 1);
  glGetTextureImage(texture.name(), 0, copied_format_of(texture.pixel()), type_of_copy<T>(),
                    static_cast<GLsizei>(out.pixels().size() * sizeof(T)), out.pixels().data());
}

}  // namespace

GlUpload::GlUpload(int width, int height)
    : staging_(static_cast<std::size_t>(width) * height * sizeof(float), GlMemory::upload) {}

template <class T, class U, class Convert>
void GlUpload::send_rows(const ImageView<T>& image, const GlTexture& texture, Convert convert,
                         U* staging) {
  assert(image.width == texture.width() && image.height == texture.height());
  // The GPU may still read what was sent before.
  sent_.wait();
  for (int v = 0; v < image.height; ++v) {
    const T* from = image.row(v);
    U* to = staging + static_cast<std::ptrdiff_t>(v) * image.width;
    for (int u = 0; u < image.width; ++u) to[u] = convert(from[u]);
  }
  glBindBuffer(GL_PIXEL_UNPACK_BUFFER, staging_.name());
  glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
  glTextureSubImage2D(texture.name(), 0, 0, 0, image.width, image.height,
                      copied_format_of(texture.pixel()), type_of(texture.pixel()), nullptr);
  glBindBuffer(GL_PIXEL_UNPACK_BUFFER, 0);
  sent_.set();
}

void GlUpload::send(DepthView depth_m, const GlTexture& texture) {
  send_rows(
      depth_m, texture, [](float z_m) { return std::isnan(z_m) ? 0.0f : z_m; },
      staging_.mapped<float>().data());
}

void GlUpload::send(const RobotImage& robot, const GlRobotImage& texture) {
  send(robot.depth_m, texture.depth_m);
  send_rows(
      robot.link_id.view(), texture.link_id, [](LinkId id) { return id; },
      staging_.mapped<LinkId>().data());
}

void GlUpload::send(const Image<PixelFate>& fate, const GlTexture& texture) {
  send_rows(
      fate.view(), texture, [](PixelFate f) { return static_cast<std::uint8_t>(f); },
      staging_.mapped<std::uint8_t>().data());
}

void read_back(const GlTexture& depth_m, DepthImage& out) {
  get_pixels(depth_m, out);
  for (float& z_m : out.pixels()) {
    if (z_m == 0) z_m = kNoDepth;
  }
}

void read_back(const GlRobotImage& robot, RobotImage& out) {
  read_back(robot.depth_m, out.depth_m);
  get_pixels(robot.link_id, out.link_id);
  out.extent = kEverywhere;
}

void read_back(const GlObstacleImage& obstacles, ObstacleImage& out) {
  read_back(obstacles.depth_m, out.depth_m);
  read_back(obstacles.fate, out);
}

void read_back(const GlTexture& fates, ObstacleImage& out) {
  get_pixels(fates, out.fate);
  out.count.fill(0);
  for (const PixelFate fate : out.fate.pixels()) ++out.count[static_cast<std::size_t>(fate)];
}

}  // namespace berth
