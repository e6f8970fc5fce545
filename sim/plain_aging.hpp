// What age leaves of free depth: the definition as it is written down.
#pragma once

#include "berth/types/camera.hpp"
#include "berth/types/image.hpp"

namespace berth::sim {

/// Free depth E of an image whose pixels free `own_m`, after something may have moved by `moved_m`;
/// the slow twin of age_free_depth(), and with 0 m that of find_free_depth().
/// `environment_front_m` has no size where there is no environment.
DepthImage plainly_aged(const Camera& camera, const DepthImage& sensor_depth_m,
                        const DepthImage& own_m, const DepthImage& environment_front_m,
                        double moved_m);

}  // namespace berth::sim
