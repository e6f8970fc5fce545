#pragma once

#include <utility>

namespace berth {

/// One number a pixel.
enum class GlPixel {
  depth_m,  ///< float
  link_id,  ///< 16-bit unsigned integer
  bits,     ///< 32-bit unsigned integer
};

/// An image on the current context's GPU, of a fixed size. Moved, not copied. Row 0 is v = 0, the
/// top of the camera's image.
class GlTexture {
 public:
  GlTexture() = default;
  GlTexture(GlPixel pixel, int width, int height);
  ~GlTexture();
  GlTexture(GlTexture&& other) noexcept { swap(other); }
  GlTexture& operator=(GlTexture&& other) noexcept {
    swap(other);
    return *this;
  }

  unsigned name() const { return name_; }
  GlPixel pixel() const { return pixel_; }
  int width() const { return width_; }
  int height() const { return height_; }

  /// All pixels 0.
  void clear() const;
  /// Its pixels, to a texture of the same kind and size.
  void copy_to(const GlTexture& target) const;

 private:
  void swap(GlTexture& other) noexcept {
    std::swap(name_, other.name_);
    std::swap(pixel_, other.pixel_);
    std::swap(width_, other.width_);
    std::swap(height_, other.height_);
  }

  unsigned name_ = 0;
  GlPixel pixel_ = GlPixel::depth_m;
  int width_ = 0;
  int height_ = 0;
};

}  // namespace berth
