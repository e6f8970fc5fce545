#include "berth/distance/mean_direction.hpp"

#include <cmath>

#include "berth/distance/metric.hpp"
#include "berth/distance/region_of_surveillance.hpp"
#include "tests/distance/answer.hpp"

namespace berth::testing {
namespace {

LinkDistances with_mean(const ImagePair& images, double range_m) {
  LinkDistances found = answer(Method::brute_force, images, range_m);
  fill_mean_directions(images.camera, images.robot, images.obstacle_depth_m, {range_m, true},
                       found);
  return found;
}

struct Mean {
  Eigen::Vector3d direction_C = Eigen::Vector3d::Zero();
  std::int64_t count = 0;
};

/// Section 6 of the definition, pixel by pixel in double.
Mean plain_mean(const ImagePair& images, Pixel r, double range_m) {
  const float z_m = images.robot.depth_m(r.u, r.v);
  const PixelRect rect = region_of_surveillance(images.camera, r, z_m, range_m);
  Mean mean;
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

TEST(MeanDirection, IsTheMeanOfUnitVectorsOverTheRegionOfSurveillance) {
  int checked = 0;
  for (std::uint32_t seed = 0; seed < 12; ++seed) {
    for (const double range_m : {0.3, 1.0, 4.0}) {
      const ImagePair images = random_images(seed, 123, 90, 4);
      for (const LinkDistance& link : with_mean(images, range_m).links) {
        if (link.status != LinkStatus::ok) continue;
        const Mean mean = plain_mean(images, link.robot_pixel, range_m);
        EXPECT_EQ(link.mean_count, mean.count);
        if (mean.count == 0) continue;
        EXPECT_LT((link.mean_direction_C.cast<double>() - mean.direction_C).norm(), 1e-5);
        ++checked;
      }
    }
  }
  EXPECT_GT(checked, 50);
}

TEST(MeanDirection, DoesNotLosePrecisionOverAWholeLargeImage) {
  ImagePair images = empty_images(1280, 720, 1);
  put_robot(images, 400, 300, 0.5f);
  put_obstacle(images, {0, 0, 1280, 720}, 1.2f);
  const LinkDistance link = with_mean(images, 2.0).links[0];
  const Mean mean = plain_mean(images, {400, 300}, 2.0);
  EXPECT_EQ(link.mean_count, 1280 * 720);
  EXPECT_LT((link.mean_direction_C.cast<double>() - mean.direction_C).norm(), 1e-6);
}

TEST(MeanDirection, OfOneObstaclePixelIsTheMinimumsDirection) {
  ImagePair images = empty_images(60, 40, 1);
  put_robot(images, 20, 10, 1.0f);
  put_obstacle(images, {40, 25, 41, 26}, 1.2f);
  const LinkDistance link = with_mean(images, 1.0).links[0];
  EXPECT_EQ(link.mean_count, 1);
  const Eigen::Vector3f minimum_C_m = link.obstacle_point_C_m - link.robot_point_C_m;
  EXPECT_TRUE(link.mean_direction_C.isApprox(minimum_C_m.normalized(), 1e-5f));
  EXPECT_TRUE(hybrid_vector_C_m(link).isApprox(minimum_C_m, 1e-5f));
}

TEST(MeanDirection, LeavesOutWhatLiesBehindTheRegion) {
  ImagePair images = empty_images(60, 40, 1);
  put_robot(images, 20, 10, 1.0f);
  put_obstacle(images, {22, 10, 23, 11}, 0.2f);
  put_obstacle(images, {24, 10, 25, 11}, 1.5f);
  put_obstacle(images, {26, 10, 27, 11}, 1.51f);
  EXPECT_EQ(with_mean(images, 0.5).links[0].mean_count, 2);
}

TEST(MeanDirection, DoesNotCountPairsThatTouch) {
  ImagePair images = empty_images(60, 40, 1);
  put_robot(images, 20, 10, 1.0f);
  put_obstacle(images, {21, 10, 22, 11}, 1.0f);
  const LinkDistance touching = with_mean(images, 1.0).links[0];
  EXPECT_EQ(touching.status, LinkStatus::ok);
  EXPECT_EQ(touching.mean_count, 0);
  EXPECT_TRUE(touching.mean_direction_C.array().isNaN().all());
  EXPECT_TRUE(hybrid_vector_C_m(touching).array().isNaN().all());
  put_obstacle(images, {30, 10, 31, 11}, 1.0f);
  EXPECT_EQ(with_mean(images, 1.0).links[0].mean_count, 1);
}

TEST(MeanDirection, OfALinkWithoutDistanceIsUnset) {
  ImagePair images = empty_images(60, 40, 2);
  put_robot(images, 20, 10, 1.0f);
  put_obstacle(images, {50, 10, 51, 11}, 1.0f);
  for (const LinkDistance& link : with_mean(images, 0.1).links) {
    expect_no_distance(link);
    EXPECT_TRUE(hybrid_vector_C_m(link).array().isNaN().all());
  }
}

TEST(MeanDirection, IsFilledOnlyWhereAskedFor) {
  ImagePair images = empty_images(60, 40, 1);
  put_robot(images, 20, 10, 1.0f);
  put_obstacle(images, {30, 10, 31, 11}, 1.0f);
  ObstacleTree tree;
  build_obstacle_tree(images.obstacle_depth_m, tree);
  ExactWorkspace workspace;
  LinkDistances out;
  for (const bool asked : {true, false}) {
    evaluate(Method::exact, images.camera, images.robot, images.obstacle_depth_m, tree, 1,
             {1.0, asked}, workspace, out);
    EXPECT_EQ(out.links[0].mean_count, asked ? 1 : 0);
  }
}

TEST(HybridVector, HasTheMinimumsLengthAndTheMeansDirection) {
  const ImagePair images = random_images(2, 160, 120, 5);
  int checked = 0;
  for (const LinkDistance& link : with_mean(images, 1.0).links) {
    if (link.mean_count == 0 || link.distance_m == 0) continue;
    const Eigen::Vector3f hybrid_C_m = hybrid_vector_C_m(link);
    EXPECT_NEAR(hybrid_C_m.norm(), link.distance_m, 1e-5);
    EXPECT_NEAR(hybrid_C_m.normalized().dot(link.mean_direction_C.normalized()), 1, 1e-5);
    ++checked;
  }
  EXPECT_GT(checked, 0);
}

}  // namespace
}  // namespace berth::testing
