#include "thesis/region_of_surveillance.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include "tests/thesis/plain_definition.hpp"

namespace berth {
namespace {

struct Case {
  Camera camera;
  Pixel pixel;
  float depth_m;
  double range_m;
};

Case random_case(std::mt19937& engine) {
  std::uniform_real_distribution<double> unit(0, 1);
  Case c;
  c.camera = {200,
              150,
              100 + 150 * unit(engine),
              100 + 150 * unit(engine),
              -60 + 320 * unit(engine),
              -60 + 270 * unit(engine)};
  c.pixel = {static_cast<int>(200 * unit(engine)), static_cast<int>(150 * unit(engine))};
  c.depth_m = static_cast<float>(0.3 + 3 * unit(engine));
  c.range_m = 0.05 + unit(engine);
  return c;
}

/// The pixels, clipped to the image, between the least and the greatest projection of points of the
/// cubes around the pixel's corners. Corner convention.
PixelRect projected(const Case& c, int steps) {
  double u_lo = HUGE_VAL;
  double u_hi = -HUGE_VAL;
  double v_lo = HUGE_VAL;
  double v_hi = -HUGE_VAL;
  const double cx = c.camera.corner_cx_px();
  const double cy = c.camera.corner_cy_px();
  for (int i = 0; i <= steps; ++i) {
    const double z = c.depth_m - c.range_m + 2 * c.range_m * i / steps;
    if (z < 1e-3) continue;
    for (int side = 0; side < 2; ++side) {
      const double x = (c.pixel.u + side - cx) * c.depth_m / c.camera.fx_px;
      const double y = (c.pixel.v + side - cy) * c.depth_m / c.camera.fy_px;
      for (int k = 0; k <= steps; ++k) {
        const double offset = c.range_m * (2.0 * k / steps - 1);
        const double u = (x + offset) / z * c.camera.fx_px + cx;
        const double v = (y + offset) / z * c.camera.fy_px + cy;
        u_lo = std::min(u_lo, u);
        u_hi = std::max(u_hi, u);
        v_lo = std::min(v_lo, v);
        v_hi = std::max(v_hi, v);
      }
    }
  }
  const auto clip = [](double x, int size) {
    return static_cast<int>(std::clamp(std::floor(x), 0.0, static_cast<double>(size)));
  };
  return {clip(u_lo, c.camera.width_px), clip(v_lo, c.camera.height_px),
          clip(u_hi + 1, c.camera.width_px), clip(v_hi + 1, c.camera.height_px)};
}

TEST(RegionOfSurveillance, HoldsEveryProjectedPointOfTheCube) {
  std::mt19937 engine(3);
  for (int i = 0; i < 3000; ++i) {
    const Case c = random_case(engine);
    const PixelRect points = projected(c, 20);
    const PixelRect rect = region_of_surveillance(c.camera, c.pixel, c.depth_m, c.range_m);
    EXPECT_LE(rect.u_begin, points.u_begin);
    EXPECT_LE(rect.v_begin, points.v_begin);
    EXPECT_GE(rect.u_end, points.u_end);
    EXPECT_GE(rect.v_end, points.v_end);
  }
}

TEST(RegionOfSurveillance, IsAtMostAPixelLargerThanTheCube) {
  std::mt19937 engine(4);
  int clipped = 0;
  for (int i = 0; i < 3000; ++i) {
    const Case c = random_case(engine);
    if (c.depth_m - c.range_m < 0.01) continue;
    const PixelRect points = projected(c, 20);
    const PixelRect rect = region_of_surveillance(c.camera, c.pixel, c.depth_m, c.range_m);
    EXPECT_GE(rect.u_begin, points.u_begin - 1);
    EXPECT_GE(rect.v_begin, points.v_begin - 1);
    EXPECT_LE(rect.u_end, points.u_end + 1);
    EXPECT_LE(rect.v_end, points.v_end + 1);
    clipped += rect.u_begin > 0;
  }
  EXPECT_GT(clipped, 500);
}

TEST(RegionOfSurveillance, IsTheWholeImageWhereTheCubeReachesTheCamera) {
  const Camera camera{200, 150, 180, 180, 99.5, 74.5};
  for (const float depth_m : {0.2f, 0.5f}) {
    const PixelRect rect = region_of_surveillance(camera, {3, 140}, depth_m, 0.5);
    EXPECT_EQ(rect.u_begin, 0);
    EXPECT_EQ(rect.v_begin, 0);
    EXPECT_EQ(rect.u_end, 200);
    EXPECT_EQ(rect.v_end, 150);
  }
}

TEST(RegionOfSurveillance, LiesInTheImageForRangesOfAnySize) {
  const Camera camera{200, 150, 180, 180, 99.5, 74.5};
  for (const double range_m : {1e-9, 0.999999, 1e300}) {
    const PixelRect rect = region_of_surveillance(camera, {3, 140}, 1.0f, range_m);
    EXPECT_TRUE(0 <= rect.u_begin && rect.u_begin <= 3 && 3 < rect.u_end && rect.u_end <= 200);
    EXPECT_TRUE(0 <= rect.v_begin && rect.v_begin <= 140 && 140 < rect.v_end && rect.v_end <= 150);
  }
}

TEST(FlaccoRegion, IsTheFrontSideAroundTheRobotPixel) {
  const Camera camera{200, 150, 180, 90, 99.5, 74.5};
  // Half sides of 180 * 0.1 / 0.9 = 20 and 10 pixels.
  EXPECT_EQ(flacco_region(camera, {100, 70}, 1.0f, 0.1), (PixelRect{80, 60, 121, 81}));
  EXPECT_EQ(flacco_region(camera, {190, 2}, 1.0f, 0.1), (PixelRect{170, 0, 200, 13}));
  EXPECT_EQ(flacco_region(camera, {100, 70}, 1.0f, 1.0), (PixelRect{0, 0, 200, 150}));
}

TEST(FlaccoRegion, LacksAPartOfTheCubeAwayFromTheAxis) {
  const Camera camera{200, 150, 60, 60, 99.5, 74.5};
  const PixelRect flacco = flacco_region(camera, {180, 74}, 1.0f, 0.1);
  const PixelRect cube = region_of_surveillance(camera, {180, 74}, 1.0f, 0.1);
  EXPECT_GT(flacco.u_begin, cube.u_begin);
  EXPECT_LT(flacco.u_end, cube.u_end);
}

TEST(RegionOfSurveillance, HoldsEveryObstaclePixelWithinTheRange) {
  std::mt19937 engine(5);
  for (int i = 0; i < 100; ++i) {
    const Case c = random_case(engine);
    const PixelRect rect = region_of_surveillance(c.camera, c.pixel, c.depth_m, c.range_m);
    for (int v = 0; v < 150; ++v) {
      for (int u = 0; u < 200; ++u) {
        if (u >= rect.u_begin && u < rect.u_end && v >= rect.v_begin && v < rect.v_end) continue;
        for (const double behind_m : {0.0, 0.3 * c.range_m, c.range_m}) {
          EXPECT_GT(
              testing::plain_distance_m(c.camera, c.pixel, c.depth_m, {u, v}, c.depth_m + behind_m),
              c.range_m);
        }
      }
    }
  }
}

}  // namespace
}  // namespace berth
