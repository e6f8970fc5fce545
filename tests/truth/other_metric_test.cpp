#include "sim/other_metric.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "sim/random.hpp"
#include "sim/random_images.hpp"
#include "tests/support/image_settings.hpp"
#include "thesis/brute_force.hpp"

namespace berth::sim {
namespace {

/// Every pair.
double plain_distance_m(OtherMetric metric, const ImagePair& images, LinkId id) {
  double least_m = 1e9;
  for (int rv = 0; rv < images.camera.height_px; ++rv) {
    for (int ru = 0; ru < images.camera.width_px; ++ru) {
      if (images.robot.link_id(ru, rv) != id) continue;
      for (int ov = 0; ov < images.camera.height_px; ++ov) {
        for (int ou = 0; ou < images.camera.width_px; ++ou) {
          const double obstacle_m = images.obstacle_depth_m(ou, ov);
          if (std::isnan(obstacle_m)) continue;
          least_m = std::min(least_m,
                             other_distance_m(metric, images.camera, {ru, rv},
                                              images.robot.depth_m(ru, rv), {ou, ov}, obstacle_m));
        }
      }
    }
  }
  return least_m;
}

TEST(OtherMetric, FindsTheLeastOfAllPairs) {
  constexpr double kRange_m = 0.5;
  int found = 0;
  for (std::uint32_t seed = 0; seed < 12; ++seed) {
    const ImagePair images = random_images(seed, 40, 30, 3);
    for (const auto metric : {OtherMetric::reading, OtherMetric::hidden_ray}) {
      const auto distances_m = other_distances_m(metric, images.camera, images.robot,
                                                 images.obstacle_depth_m, 3, kRange_m);
      for (LinkId id = 1; id <= 3; ++id) {
        const double plain_m = plain_distance_m(metric, images, id);
        ASSERT_EQ(distances_m[id - 1].has_value(), plain_m <= kRange_m) << seed << ' ' << id;
        if (!distances_m[id - 1]) continue;
        EXPECT_DOUBLE_EQ(*distances_m[id - 1], plain_m) << seed << ' ' << id;
        ++found;
      }
    }
  }
  EXPECT_GT(found, 20);
}

TEST(OtherMetric, TheHiddenRayIsNeverFartherThanItsReadingNorThanHirtsPoint) {
  int nearer = 0;
  for (std::uint32_t seed = 0; seed < 12; ++seed) {
    const ImagePair images = random_images(seed, 60, 45, 3);
    const auto distances_m = [&](OtherMetric metric) {
      return other_distances_m(metric, images.camera, images.robot, images.obstacle_depth_m, 3, 9);
    };
    const auto reading_m = distances_m(OtherMetric::reading);
    const auto ray_m = distances_m(OtherMetric::hidden_ray);
    LinkDistances hirt;
    brute_force({images.camera, images.robot, 3, SearchableDepth(images.obstacle_depth_m),
                 testing::image_settings(9)},
                hirt);
    for (int i = 0; i < 3; ++i) {
      if (hirt.links[i].status != LinkStatus::ok) continue;
      EXPECT_LE(*ray_m[i], *reading_m[i] + 1e-9);
      EXPECT_LE(*ray_m[i], hirt.links[i].distance_m + 1e-5);
      if (*ray_m[i] < hirt.links[i].distance_m - 1e-3) ++nearer;
    }
  }
  EXPECT_GT(nearer, 0) << "nothing was to be seen here";
}

/// What kMaxOverestimate_px's formula rests on.
TEST(OtherMetric, HirtsPointIsNoFartherThanTheWholeRayDividedByTheCosine) {
  Random random(3);
  double greatest_ratio = 0;
  for (int i = 0; i < 100000; ++i) {
    const Eigen::Vector3d robot_C(random(-1, 1), random(-1, 1), random(0.3, 2));
    const Eigen::Vector3d ray(random(-1, 1), random(-1, 1), 1);
    const double reading_m = random(0.3, 3);
    const double hirt_m = (std::max(reading_m, robot_C.z()) * ray - robot_C).norm();
    const double nearest = std::max(reading_m, robot_C.dot(ray) / ray.squaredNorm());
    const double whole_ray_m = (nearest * ray - robot_C).norm();
    EXPECT_LE(hirt_m, whole_ray_m * ray.norm() * (1 + 1e-9));
    greatest_ratio = std::max(greatest_ratio, hirt_m / (whole_ray_m * ray.norm()));
  }
  EXPECT_GT(greatest_ratio, 0.99) << "a smaller bound would do";
}

}  // namespace
}  // namespace berth::sim
