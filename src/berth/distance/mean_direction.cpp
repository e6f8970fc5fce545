#include "berth/distance/mean_direction.hpp"

#include <limits>

#include "berth/distance/direction_sum.hpp"
#include "berth/distance/region_of_surveillance.hpp"

namespace berth {

void fill_mean_directions(const Camera& camera, const RobotImage& robot, DepthView obstacle_depth_m,
                          const DistanceSettings& settings, LinkDistances& distances) {
  validate(settings);
  const Metric metric = metric_of(camera);
  for (LinkDistance& link : distances.links) {
    link.mean_direction_C.setConstant(std::numeric_limits<float>::quiet_NaN());
    link.mean_count = 0;
    if (link.status != LinkStatus::ok) continue;

    const Pixel pixel = link.robot_pixel;
    const float depth_m = robot.depth_m(pixel.u, pixel.v);
    const DirectionSum sum = sum_directions(
        metric,
        {static_cast<float>(pixel.u), static_cast<float>(pixel.v), depth_m,
         static_cast<float>(depth_m + settings.range_m)},
        obstacle_depth_m, region_of_surveillance(camera, pixel, depth_m, settings.range_m));
    if (sum.count == 0) continue;
    link.mean_count = static_cast<std::int64_t>(sum.count);
    link.mean_direction_C = (Eigen::Vector3d(sum.x, sum.y, sum.z) / sum.count).cast<float>();
  }
}

Eigen::Vector3f hybrid_vector_C_m(const LinkDistance& link) {
  return link.mean_direction_C / link.mean_direction_C.norm() * link.distance_m;
}

}  // namespace berth
