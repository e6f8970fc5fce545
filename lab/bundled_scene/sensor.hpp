// A Kinect-like depth camera: structured light, so what it measures is a disparity.
#pragma once

#include <random>

#include "berth/types/camera.hpp"
#include "berth/types/image.hpp"
#include "lab/bundled_scene/ray_caster.hpp"

namespace berth::lab {

/// A ray of light for each pixel, and whether the projector beside the camera reaches the same
/// point.
struct CleanView {
  Image<SensorHit> hit;
  Image<std::uint8_t> lit;
};
CleanView look(const RayCaster& scene, const Camera& camera);

/// The sensor's image, in mm; 0 where it has no reading. On top of the clean view, in this order:
/// outlines that wander by a pixel, some mixed pixels on them, disparity noise (1.5 mm at 1 m,
/// growing with z^2), whole disparity steps (2.9 mm at 1 m, growing with z^2), and no reading in
/// the projector's shadow, along depth edges, on surfaces seen at a flat angle, in a few small
/// spots and out of range.
Image<std::uint16_t> sense(const CleanView& view, std::mt19937& random);

}  // namespace berth::lab
