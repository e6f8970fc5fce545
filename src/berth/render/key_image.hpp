// Inside render/ only.
#pragma once

#include <algorithm>
#include <bit>
#include <cstdint>
#include <vector>

#include "berth/types/robot_image.hpp"

namespace berth {

/// What a pixel shows, as one number: the greater key is the nearer surface, and of two at the same
/// depth the smaller id. So the greatest key does not depend on the order of drawing. The upper
/// half is the inverse depth, a positive float, whose bits sort as it does; 0 where nothing is.
using PixelKey = std::int64_t;

/// The lower half of a key.
inline PixelKey id_part(LinkId id) { return static_cast<LinkId>(~id); }
inline PixelKey make_key(float inverse_depth, PixelKey id) {
  return static_cast<PixelKey>(std::bit_cast<std::uint32_t>(inverse_depth)) << 32 | id;
}
inline float inverse_depth_of(PixelKey key) {
  return std::bit_cast<float>(static_cast<std::uint32_t>(key >> 32));
}
inline LinkId id_of(PixelKey key) { return static_cast<LinkId>(~key); }

/// Rows of keys without gaps.
class KeyImage {
 public:
  /// Vectors that begin in the image may end beyond it.
  static constexpr int kPadding = 16;

  KeyImage(int width, int height)
      : width_(width), keys_(static_cast<std::size_t>(width) * height + kPadding) {}

  int width() const { return width_; }
  std::ptrdiff_t place(int u, int v) const { return static_cast<std::ptrdiff_t>(v) * width_ + u; }
  PixelKey* data() { return keys_.data(); }
  PixelKey* row(int v) { return keys_.data() + place(0, v); }

  /// The inverse depth from which on each pixel's surfaces do not count, where only those behind
  /// others do. As long as the keys.
  const float* ceilings() const { return ceilings_; }
  void set_ceilings(const float* ceilings) { ceilings_ = ceilings; }

 private:
  int width_;
  const float* ceilings_ = nullptr;
  std::vector<PixelKey> keys_;
};

}  // namespace berth
