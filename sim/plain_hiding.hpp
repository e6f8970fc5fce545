// From where on each pixel hides, by its definition alone.
#pragma once

#include <Eigen/Core>

#include "berth/space/settings.hpp"
#include "berth/types/camera.hpp"
#include "berth/types/obstacle_image.hpp"

namespace berth::sim {

/// H of each pixel: infinite where it hides nothing. `own_m` is what the pixels free, closed.
DepthImage plainly_hidden_from(const Camera& camera, const DepthImage& sensor_depth_m,
                               const DepthImage& obstacle_depth_m, const Image<PixelFate>& fate,
                               const DepthImage& own_m, const SpaceSettings& settings);

/// The depth at which hiding ends in a pixel: the greatest front of environment in 3 x 3, infinite
/// where one of them shows none, at the image's border, and where there is no environment.
double plainly_hidden_to(const DepthImage& environment_front_m, Pixel pixel);

}  // namespace berth::sim
