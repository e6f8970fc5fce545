// A Kinect-like depth camera: structured light, so what it measures is a disparity, and what its
// projector does not reach has none. sensor_model.hpp has errors that are given as numbers.
#pragma once

#include "berth/types/camera.hpp"
#include "berth/types/image.hpp"
#include "sim/random.hpp"
#include "sim/ray_caster.hpp"

namespace berth::sim {

/// A ray of light for each pixel, and whether the projector beside the camera reaches the same
/// point.
struct CleanView {
  Image<SurfaceHit> hit;
  Image<std::uint8_t> lit;
};
CleanView look(const RayCaster& scene);

/// The sensor's image, in mm; 0 where it has no reading. On top of the clean view, in this order:
/// outlines that wander by a pixel, some mixed pixels on them, disparity noise (1.5 mm at 1 m,
/// growing with z^2), whole disparity steps (2.9 mm at 1 m, growing with z^2), and no reading in
/// the projector's shadow, along depth edges, on surfaces seen at a flat angle, in a few small
/// spots and out of range.
Image<std::uint16_t> sense(const CleanView& view, Random& random);

}  // namespace berth::sim
