#pragma once

#include "berth/distance/settings.hpp"
#include "berth/types/camera.hpp"
#include "berth/types/link_distance.hpp"

namespace berth {

/// Fills mean_direction_C and mean_count of every link from its closest robot pixel (Hirt 2.2.5):
/// the mean of the unit vectors to every obstacle pixel in that pixel's region of surveillance, of
/// half side range_m, never shrunk. The region has no nearest depth, because of the gray area; its
/// farthest is the robot pixel's depth + range_m. A pair at distance 0 has no direction and does
/// not count. NaN and 0 for a link that is not ok, or that nothing counts for.
void fill_mean_directions(const Camera& camera, const RobotImage& robot, DepthView obstacle_depth_m,
                          const DistanceSettings& settings, LinkDistances& distances);

/// The minimum's magnitude with the mean's direction (Flacco), in frame C; NaN where either is
/// missing or the mean has no direction.
Eigen::Vector3f hybrid_vector_C_m(const LinkDistance& link);

}  // namespace berth
