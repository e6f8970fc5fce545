// What Hirt's metric could be instead: slow, to compare with.
#pragma once

#include <optional>
#include <vector>

#include "berth/types/camera.hpp"
#include "berth/types/robot_image.hpp"

namespace berth::sim {

/// Where on its ray an obstacle pixel with depth dO is taken, for a robot pixel with depth dR.
enum class OtherMetric {
  reading,     ///< at dO: no gray area
  hidden_ray,  ///< at the nearest point of the hidden part from dO to dR; at dO where that is
               ///< behind
};

/// Per link (id i + 1) the least distance over all pairs of its pixels and the obstacles', between
/// facing sides as in Hirt 2.10 to 2.13; nothing where none is within range_m. Both images have the
/// camera's size.
std::vector<std::optional<double>> other_distances_m(OtherMetric metric, const Camera& camera,
                                                     const RobotImage& robot,
                                                     const DepthImage& obstacle_depth_m,
                                                     int link_count, double range_m);

/// That of a single pair.
double other_distance_m(OtherMetric metric, const Camera& camera, Pixel robot, double robot_depth_m,
                        Pixel obstacle, double obstacle_depth_m);

}  // namespace berth::sim
