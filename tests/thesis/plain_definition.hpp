#pragma once

#include <optional>

#include "sim/random_images.hpp"

namespace berth::testing {

/// Hirt 2.10 to 2.14 as it is written, in double and with branches: a second opinion on the metric.
double plain_distance_m(const Camera& camera, Pixel robot, double robot_depth_m, Pixel obstacle,
                        double obstacle_depth_m);

/// The least plain_distance_m over all pairs of a link's pixels and the obstacle pixels; nothing if
/// there is no pair.
std::optional<double> plain_least_distance_m(const sim::ImagePair& images, LinkId link);

}  // namespace berth::testing
