#include "thesis/mean_direction/mean_direction.hpp"

#include "tests/thesis/answer.hpp"
#include "tests/thesis/mean_direction/plain_mean.hpp"

namespace berth::testing {
namespace {

TEST(MeanDirection, OfOneObstaclePixelIsTheMinimumsDirection) {
  sim::ImagePair images = sim::empty_images(60, 40, 1);
  put_robot(images, 20, 10, 1.0f);
  put_obstacle(images, {40, 25, 41, 26}, 1.2f);
  const LinkDistance link = with_mean(images, 1.0).links[0];
  EXPECT_EQ(link.mean_count, 1);
  const Eigen::Vector3f minimum_C_m = link.obstacle_point_C_m - link.robot_point_C_m;
  EXPECT_TRUE(link.mean_direction_C.isApprox(minimum_C_m.normalized(), 1e-5f));
  EXPECT_TRUE(hybrid_vector_C_m(link).isApprox(minimum_C_m, 1e-5f));
}

TEST(MeanDirection, LeavesOutWhatLiesBehindTheRegion) {
  sim::ImagePair images = sim::empty_images(60, 40, 1);
  put_robot(images, 20, 10, 1.0f);
  put_obstacle(images, {22, 10, 23, 11}, 0.2f);
  put_obstacle(images, {24, 10, 25, 11}, 1.5f);
  put_obstacle(images, {26, 10, 27, 11}, 1.51f);
  EXPECT_EQ(with_mean(images, 0.5).links[0].mean_count, 2);
}

TEST(MeanDirection, DoesNotCountPairsThatTouch) {
  sim::ImagePair images = sim::empty_images(60, 40, 1);
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
  sim::ImagePair images = sim::empty_images(60, 40, 2);
  put_robot(images, 20, 10, 1.0f);
  put_obstacle(images, {50, 10, 51, 11}, 1.0f);
  for (const LinkDistance& link : with_mean(images, 0.1).links) {
    expect_no_distance(link);
    EXPECT_TRUE(hybrid_vector_C_m(link).array().isNaN().all());
  }
}

TEST(MeanDirection, IsFilledOnlyWhereAskedFor) {
  sim::ImagePair images = sim::empty_images(60, 40, 1);
  put_robot(images, 20, 10, 1.0f);
  put_obstacle(images, {30, 10, 31, 11}, 1.0f);
  SearchableDepth obstacles;
  obstacles.build(images.obstacle_depth_m);
  EvaluateWorkspace workspace;
  LinkDistances out;
  for (const bool asked : {true, false}) {
    evaluate(Method::exact, {images.camera, images.robot, 1, obstacles, image_settings(1.0, asked)},
             workspace, out);
    EXPECT_EQ(out.links[0].mean_count, asked ? 1 : 0);
  }
}

TEST(HybridVector, HasTheMinimumsLengthAndTheMeansDirection) {
  const sim::ImagePair images = sim::random_images(2, 160, 120, 5);
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
