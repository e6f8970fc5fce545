// Things too small to hide anybody do not hide: the definition as it is written down.
#pragma once

#include "berth/space/settings.hpp"
#include "berth/types/camera.hpp"
#include "berth/types/image.hpp"
#include "berth/types/obstacle_image.hpp"

namespace berth::sim {

/// Rounded down to what depths of space are counted in, 1/2048 m; what is beyond 32 m is just
/// before it, unless nothing ends it.
float plainly_counted(float depth_m);
/// The same upwards, of a length.
double plainly_counted_up(double length_m);

/// d of these settings for this camera; the slow twin of detection_capability_m().
double plainly_told_m(const SpaceSettings& settings, const Camera& camera);

/// What each pixel frees (`own_m`), where one without a reading is a hole beside the robot; the
/// slow twin of free_holes_beside_robot(). S, F and the fates have the same size.
DepthImage plainly_freed_beside_robot(const Camera& camera, DepthView sensor_depth_m,
                                      DepthView obstacle_depth_m, const Image<PixelFate>& fate,
                                      const DepthImage& own_m, double detection_capability_m);

/// What each pixel frees (`own_m`), raised where no ball of the diameter d could stand at that
/// depth that the camera would have missed; the slow twin of close_free_depth().
DepthImage plainly_closed(const Camera& camera, const DepthImage& own_m,
                          double detection_capability_m);

}  // namespace berth::sim
