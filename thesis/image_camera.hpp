#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>

#include "thesis/image_result.hpp"

namespace berth {

/// The images of one camera of a scene, wherever they are computed on.
class ImageCamera {
 public:
  virtual ~ImageCamera() = default;

  /// Learns a background, where the camera's settings ask for one.
  virtual void begin(const std::function<void()>& before_image) = 0;
  /// Reads and filters the camera's image of this number.
  virtual void observe(std::size_t image) = 0;
  /// The rest is about the last image. Its result at the joint angles of its exposure.
  virtual const ImageResult& ask() = 0;
  virtual std::array<std::int64_t, kPixelFateCount> fate_counts() = 0;
  /// Whatever its images say, the camera is implausible.
  virtual void distrust() = 0;
};

}  // namespace berth
