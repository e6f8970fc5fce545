#include "tests/thesis/mean_direction/plain_mean.hpp"

#include "tests/support/image_settings.hpp"
#include "thesis/metric.hpp"
#include "thesis/region_of_surveillance.hpp"

namespace berth::testing {

LinkDistances with_mean(const sim::ImagePair& images, double range_m) {
  LinkDistances found = answer(Method::exact, images, range_m);
  SearchableDepth obstacles;
  obstacles.build(images.obstacle_depth_m);
  DirectionWorkspace workspace;
  fill_mean_directions(
      {images.camera, images.robot, images.link_count, obstacles, image_settings(range_m, true)},
      workspace, found);
  return found;
}

PlainMean plain_mean(const sim::ImagePair& images, Pixel r, double range_m) {
  const float z_m = images.robot.depth_m(r.u, r.v);
  const PixelRect rect = region_of_surveillance(images.camera, r, z_m, range_m);
  PlainMean mean;
  for (int v = rect.v_begin; v < rect.v_end; ++v) {
    for (int u = rect.u_begin; u < rect.u_end; ++u) {
      const float depth_m = images.obstacle_depth_m(u, v);
      if (!(depth_m <= static_cast<float>(z_m + range_m))) continue;
      const auto pair =
          pair_vector(metric_of(images.camera), static_cast<float>(r.u), static_cast<float>(r.v),
                      z_m, static_cast<float>(u), static_cast<float>(v), depth_m);
      const Eigen::Vector3d vector_C_m(pair.x_m, pair.y_m, pair.z_m);
      if (vector_C_m.norm() == 0) continue;
      mean.direction_C += vector_C_m.normalized();
      ++mean.count;
    }
  }
  mean.direction_C /= static_cast<double>(mean.count);
  return mean;
}

int expect_plain_means(const sim::ImagePair& images, double range_m, double max_error) {
  int links = 0;
  for (const LinkDistance& link : with_mean(images, range_m).links) {
    if (link.status != LinkStatus::ok) continue;
    const PlainMean mean = plain_mean(images, link.robot_pixel, range_m);
    EXPECT_EQ(link.mean_count, mean.count);
    if (mean.count == 0) continue;
    EXPECT_LT((link.mean_direction_C.cast<double>() - mean.direction_C).norm(), max_error);
    ++links;
  }
  return links;
}

}  // namespace berth::testing
