// The mean direction from tiles against all readings one by one.
#include "berth/distance/mean_directions.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "sim/random.hpp"

namespace berth {
namespace {

DepthImage draw_image(sim::Random& random, int width, int height) {
  DepthImage image(width, height, kNoDepth);
  for (int v = 0; v < height; ++v) {
    for (int u = 0; u < width; ++u) {
      if (random(0, 1) < 0.2) continue;
      const bool is_step = u / 13 % 2 == v / 17 % 2;
      image(u, v) = static_cast<float>((is_step ? 0.8 : 1.6) + random(0, 0.05));
    }
  }
  return image;
}

TEST(MeshMeanDirection, IsThatOfAllReadingsWithinTheRange) {
  sim::Random random(7);
  const Camera camera{90, 71, 80, 82, 44, 36};
  for (int round = 0; round < 20; ++round) {
    const DepthImage images[] = {draw_image(random, 90, 71), draw_image(random, 90, 71)};
    Pose X_BC[] = {Pose::Identity(), Pose(Eigen::AngleAxisd(1.2, Eigen::Vector3d::UnitY()))};
    X_BC[1].translation() = Eigen::Vector3d(0.4, 0.1, -0.2);
    ReadingTiles tiles[2];
    std::vector<DirectionCamera> views;
    for (int k = 0; k < 2; ++k) {
      build_reading_tiles(camera, images[k], tiles[k]);
      views.push_back({camera, images[k], tiles[k], X_BC[k]});
    }
    const Eigen::Vector3d p_B_m(random(-0.5, 0.5), random(-0.5, 0.5), random(0.3, 1.2));
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    int count = 0;
    for (int k = 0; k < 2; ++k) {
      for (int v = 0; v < 71; ++v) {
        for (int u = 0; u < 90; ++u) {
          const double z = images[k](u, v);
          if (std::isnan(z)) continue;
          const Eigen::Vector3d q_C((u - 44) * z / 80, (v - 36) * z / 82, z);
          const Eigen::Vector3d way = X_BC[k] * q_C - p_B_m;
          if (way.norm() > 30) continue;
          sum += way.normalized();
          ++count;
        }
      }
    }
    const MeanDirection found = mean_direction(views, p_B_m, 30);
    EXPECT_EQ(found.count, count) << "nothing is cut by the range";
    EXPECT_LT((found.direction_B.cast<double>() - sum / count).norm(), 0.04);
  }
}

TEST(MeshMeanDirection, OfNothingIsNone) {
  const Camera camera{9, 7, 10, 10, 4, 3};
  ReadingTiles tiles;
  const DepthImage image(9, 7, kNoDepth);
  build_reading_tiles(camera, image, tiles);
  const DirectionCamera view{camera, image, tiles, Pose::Identity()};
  const MeanDirection found = mean_direction({&view, 1}, {0, 0, 1}, 1);
  EXPECT_EQ(found.count, 0);
  EXPECT_TRUE(found.direction_B.hasNaN());
}

}  // namespace
}  // namespace berth
