// Images: rows of pixels, (0, 0) top left, u to the right, v down.
#pragma once

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

namespace berth {

/// Somebody else's pixels, read only. `stride` counts elements from one row to the next.
template <typename T>
struct ImageView {
  const T* data = nullptr;
  int width = 0;
  int height = 0;
  std::ptrdiff_t stride = 0;

  const T* row(int v) const { return data + v * stride; }
  const T& operator()(int u, int v) const {
    assert(u >= 0 && u < width && v >= 0 && v < height);
    return row(v)[u];
  }
};

/// An image that owns its pixels, without gaps between the rows.
template <typename T>
class Image {
 public:
  Image() = default;
  Image(int width, int height, T fill = T{})
      : width_(width), height_(height), pixels_(static_cast<std::size_t>(width) * height, fill) {}

  int width() const { return width_; }
  int height() const { return height_; }
  T* row(int v) { return pixels_.data() + static_cast<std::ptrdiff_t>(v) * width_; }
  const T* row(int v) const { return pixels_.data() + static_cast<std::ptrdiff_t>(v) * width_; }
  T& operator()(int u, int v) {
    assert(u >= 0 && u < width_ && v >= 0 && v < height_);
    return row(v)[u];
  }
  const T& operator()(int u, int v) const {
    assert(u >= 0 && u < width_ && v >= 0 && v < height_);
    return row(v)[u];
  }
  std::vector<T>& pixels() { return pixels_; }
  const std::vector<T>& pixels() const { return pixels_; }

  /// Keeps its memory where the new size needs no more.
  void resize(int width, int height, T fill) {
    width_ = width;
    height_ = height;
    pixels_.assign(static_cast<std::size_t>(width) * height, fill);
  }

  ImageView<T> view() const { return {pixels_.data(), width_, height_, width_}; }
  operator ImageView<T>() const { return view(); }

 private:
  int width_ = 0;
  int height_ = 0;
  std::vector<T> pixels_;
};

/// Depth in metres along the optical axis (z, not along the ray); NaN where there is none.
using DepthImage = Image<float>;
using DepthView = ImageView<float>;  ///< the same, of memory that somebody else holds

inline constexpr float kNoDepth = std::numeric_limits<float>::quiet_NaN();  ///< no reading

/// A pixel's coordinates; (-1, -1) where there is no pixel.
struct Pixel {
  int u = -1;
  int v = -1;
  bool operator==(const Pixel&) const = default;
};

/// The pixels with u_begin <= u < u_end and v_begin <= v < v_end.
struct PixelRect {
  int u_begin = 0;
  int v_begin = 0;
  int u_end = 0;
  int v_end = 0;
  bool empty() const { return u_begin >= u_end || v_begin >= v_end; }
  bool operator==(const PixelRect&) const = default;
};

/// Every pixel of every image.
inline constexpr PixelRect kEverywhere{0, 0, std::numeric_limits<int>::max(),
                                       std::numeric_limits<int>::max()};

/// The part of `rect` that lies in an image of this size.
inline PixelRect clip(const PixelRect& rect, int width, int height) {
  return {std::clamp(rect.u_begin, 0, width), std::clamp(rect.v_begin, 0, height),
          std::clamp(rect.u_end, 0, width), std::clamp(rect.v_end, 0, height)};
}

/// The least rectangle that holds both.
inline PixelRect united(const PixelRect& a, const PixelRect& b) {
  if (a.empty()) return b;
  if (b.empty()) return a;
  return {std::min(a.u_begin, b.u_begin), std::min(a.v_begin, b.v_begin),
          std::max(a.u_end, b.u_end), std::max(a.v_end, b.v_end)};
}

/// With this number of pixels more on each side; may reach beyond the image.
inline PixelRect grown_by(const PixelRect& rect, int reach_px) {
  return {rect.u_begin - reach_px, rect.v_begin - reach_px, rect.u_end + reach_px,
          rect.v_end + reach_px};
}

}  // namespace berth
