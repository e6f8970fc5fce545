#pragma once

#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "berth/types/camera.hpp"
#include "berth/types/image.hpp"

namespace berth {

/// What a depth image's numbers are.
enum class DepthIs { along_axis, along_ray };

/// Makes depth images as a camera gives them into those of a pinhole camera: along the axis, and
/// without what the lens bends. Each reading is kept: what falls into one pixel with another is
/// told where it is the nearer one. Rays from 75 degrees to the axis on have no place.
class Rectification {
 public:
  /// `given` is the camera of the lens's middle, as camera_info's K.
  Rectification(const Camera& given, const std::optional<Lens>& lens, DepthIs depth_is);

  /// Of the images that come.
  const Camera& given() const { return given_; }
  const std::optional<Lens>& lens() const { return lens_; }
  /// Of the images that are made: the same focal length, and as large as the lens sees, up to four
  /// times as many pixels; beyond that with a shorter focal length.
  const Camera& camera() const { return camera_; }

  /// `given_m` has the size of given(); the other becomes as large as camera(). NaN where no ray of
  /// the image goes.
  void apply(DepthView given_m, DepthImage& made_m) const;
  DepthImage apply(DepthView given_m) const;

 private:
  void find_camera(const class LensRays& rays);
  void find_pixels(const class LensRays& rays);

  Camera given_;
  std::optional<Lens> lens_;
  Camera camera_;
  DepthIs depth_is_;
  /// For each pixel that is made the one that it is taken from, or -1.
  std::vector<std::int32_t> from_;
  /// What no pixel is taken from, and where it falls.
  std::vector<std::pair<std::int32_t, std::int32_t>> more_;
};

}  // namespace berth
