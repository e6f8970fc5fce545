// The bounds along surfaces, for the instruction set that this file is compiled for; the tests of
// exactness run them on every one.
#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <random>

#include "tests/support/thinned.hpp"
#include "thesis/exact/aligned_box-inl.hpp"

namespace berth {
namespace {
namespace simd = HWY_NAMESPACE;

class Sampler {
 public:
  int whole(int lo, int hi) { return std::uniform_int_distribution<int>(lo, hi)(engine_); }
  float real(float lo, float hi) { return std::uniform_real_distribution<float>(lo, hi)(engine_); }

 private:
  std::mt19937 engine_{11};
};

/// A tile of a plane with noise, and with holes.
struct RandomTile {
  float depth_m[kTilePixels];
  LeafTile tile;

  RandomTile(Sampler& sample, float scale_m) {
    const float begin_m = scale_m * sample.real(0.5f, 2);
    const float per_u_m = scale_m * sample.real(-0.05f, 0.05f);
    const float per_v_m = scale_m * sample.real(-0.05f, 0.05f);
    const float noise_m = scale_m * (sample.whole(0, 1) == 0 ? 1e-4f : 0.05f);
    tile.box = {0, 0, 0, 0, HUGE_VALF, -HUGE_VALF};
    for (int i = 0; i < kTilePixels; ++i) {
      depth_m[i] = begin_m + per_u_m * static_cast<float>(i % 8) +
                   per_v_m * static_cast<float>(i / 8) + sample.real(0, noise_m);
      if (sample.whole(0, 9) == 0) depth_m[i] = kNoDepth;
      tile.box.depth_lo_m = std::fmin(tile.box.depth_lo_m, depth_m[i]);
      tile.box.depth_hi_m = std::fmax(tile.box.depth_hi_m, depth_m[i]);
    }
    tile.u = 8.0f * static_cast<float>(sample.whole(0, 20));
    tile.v = 8.0f * static_cast<float>(sample.whole(0, 20));
    tile.depths = {depth_m, 8};
    tile.bits = ~std::uint64_t{0};
  }
};

float pair_m2(const Metric& metric, const RandomTile& robot, int r, const RandomTile& obstacle,
              int o) {
  return squared_distance_m2(metric, robot.tile.u + static_cast<float>(r % 8),
                             robot.tile.v + static_cast<float>(r / 8), robot.depth_m[r],
                             obstacle.tile.u + static_cast<float>(o % 8),
                             obstacle.tile.v + static_cast<float>(o / 8), obstacle.depth_m[o]);
}

Metric random_metric(Sampler& sample) {
  return {sample.real(-60, 250), sample.real(-60, 250), 1 / sample.real(40, 900),
          1 / sample.real(40, 900)};
}

Axes random_axes(Sampler& sample, const Metric& metric, const RandomTile& robot) {
  if (sample.whole(0, 1) == 0)
    return axes_of(metric, {sample.real(-1, 1), sample.real(-1, 1), sample.real(-1, 1)});
  return axes_along(metric, simd::fit_plane(robot.tile), robot.tile.u, robot.tile.v);
}

TEST(AlignedBound, IsNeverAboveTheComputedDistanceOfAnyPair) {
  Sampler sample;
  int tight = 0;
  for (int i = 0; i < thinned(4000); ++i) {
    const float scale_m = std::exp(sample.real(-2, 4));
    const Metric metric = random_metric(sample);
    const RandomTile robot(sample, scale_m);
    const RandomTile obstacle(sample, scale_m);
    const Axes axes = random_axes(sample, metric, robot);
    const AlignedBox robot_box =
        simd::AlignedCamera(metric, axes, robot.tile, {0, 0}).box_of(~0ULL);
    const simd::AlignedCamera view(metric, axes, obstacle.tile,
                                   {robot.tile.box.depth_lo_m, robot.tile.box.depth_hi_m});
    for (int o = 0; o < kTilePixels; o += 5) {
      const AlignedBox pixel = view.box_of(1ULL << o);
      float gap_m2 = 0;
      for (int k = 0; k < 3; ++k) {
        const float gap_m = std::fmax(
            0.0f, std::fmax(pixel.lo_m[k] - robot_box.hi_m[k], robot_box.lo_m[k] - pixel.hi_m[k]));
        gap_m2 += gap_m * gap_m;
      }
      for (int r = 0; r < kTilePixels; ++r) {
        const float distance_m2 = pair_m2(metric, robot, r, obstacle, o);
        if (std::isnan(distance_m2)) continue;
        ASSERT_LE(gap_m2 * kOrthonormal, distance_m2);
        tight += gap_m2 > 0.98f * distance_m2;
        // The search keeps the pixel for every limit above one of its pairs.
        ASSERT_TRUE(view.pixels_near(robot_box, std::nextafter(distance_m2, HUGE_VALF)) >> o & 1);
      }
    }
  }
  EXPECT_GT(tight, thinned(1000));
}

TEST(AlignedBound, PixelsFarFromTheBoxAreNotNear) {
  Sampler sample;
  const Metric metric{80, 60, 1 / 100.0f, 1 / 100.0f};
  const RandomTile tile(sample, 1);
  const simd::AlignedCamera view(metric, axes_of(metric, {0, 0, 1}), tile.tile, {0, 0});
  EXPECT_EQ(view.pixels_near({{-0.1f, -0.1f, 9}, {0.1f, 0.1f, 9.1f}}, 1), 0u);
}

TEST(SurfaceAxes, ThePlaneOfATileGivesItsNormal) {
  const Metric metric{80, 60, 1 / 100.0f, 1 / 120.0f};
  // The plane n p = 1.
  const float n[3] = {0.3f, -0.2f, 0.9f};
  RandomTile tile{*std::make_unique<Sampler>(), 1};
  for (int i = 0; i < kTilePixels; ++i) {
    const float x = (tile.tile.u + static_cast<float>(i % 8) + 0.5f - metric.cx_px) * metric.inv_fx;
    const float y = (tile.tile.v + static_cast<float>(i / 8) + 0.5f - metric.cy_px) * metric.inv_fy;
    tile.depth_m[i] = i % 7 == 0 ? kNoDepth : 1 / (n[0] * x + n[1] * y + n[2]);
  }
  const Axes axes = axes_along(metric, simd::fit_plane(tile.tile), tile.tile.u, tile.tile.v);
  const float length = std::sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
  EXPECT_NEAR(axes.x[0], n[0] / length, 1e-3);
  EXPECT_NEAR(axes.y[0], n[1] / length, 1e-3);
  EXPECT_NEAR(axes.z[0], n[2] / length, 1e-3);
}

TEST(SurfaceAxes, AreOrthonormalForEveryNormal) {
  const Metric metric{80, 60, 1 / 100.0f, 1 / 120.0f};
  Sampler sample;
  for (int i = 0; i < 1000; ++i) {
    const float scale = std::exp(sample.real(-20, 20));
    const Axes a = i == 0 ? axes_of(metric, {0, 0, 0})
                          : axes_of(metric, {scale * sample.real(-1, 1), scale * sample.real(-1, 1),
                                             scale * sample.real(-1, 1)});
    for (int j = 0; j < 3; ++j) {
      for (int k = 0; k < 3; ++k) {
        EXPECT_NEAR(a.x[j] * a.x[k] + a.y[j] * a.y[k] + a.z[j] * a.z[k], j == k ? 1 : 0, 1e-6);
      }
    }
  }
}

TEST(SurfaceAxes, WithoutAPlaneTheyAreTheCameras) {
  const Metric metric{80, 60, 1 / 100.0f, 1 / 120.0f};
  const float two_pixels[9] = {2, 1, 0, 1, 0, 0, 2, 1, 0};
  const Axes axes = axes_along(metric, solve_plane(two_pixels), 0, 0);
  EXPECT_EQ(axes.z[0], 1);
}

}  // namespace
}  // namespace berth
