#pragma once

#include "berth/types/camera.hpp"
#include "berth/types/image.hpp"
#include "thesis/surveillance_settings.hpp"

namespace berth {

/// The image rectangle that holds the cube of half side range_m around every point of a robot pixel
/// at its depth (Hirt 2.2.3, algorithm 1; the printed 2.17 and 2.18 divide by y -+ L where they
/// mean the depth z -+ L), clipped to the image. Every obstacle pixel within range_m of the robot
/// pixel lies in it. The whole image where depth_m <= range_m: the cube then reaches the camera's
/// plane.
PixelRect region_of_surveillance(const Camera& camera, Pixel robot_pixel, float depth_m,
                                 double range_m);

/// Flacco's approximation (Hirt 2.15, 2.16): the cube's front side, projected as if it lay on the
/// optical axis, around the robot pixel; clipped to the image. Away from the axis obstacle pixels
/// within range_m may lie outside. The whole image where depth_m <= range_m.
PixelRect flacco_region(const Camera& camera, Pixel robot_pixel, float depth_m, double range_m);

/// The one that is named.
PixelRect region_of_surveillance(SurveillanceRegion region, const Camera& camera, Pixel robot_pixel,
                                 float depth_m, double range_m);

}  // namespace berth
