#include "thesis/exact/lower_bound.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace berth {
namespace {

class PixelSampler {
 public:
  float whole(int lo, int hi) {
    return static_cast<float>(std::uniform_int_distribution<int>(lo, hi)(engine_));
  }
  float real(float lo, float hi) { return std::uniform_real_distribution<float>(lo, hi)(engine_); }

 private:
  std::mt19937 engine_{7};
};

PixelBox random_box(PixelSampler& sample) {
  const float u = sample.whole(0, 60);
  const float v = sample.whole(0, 60);
  const float depth_m = std::exp(sample.real(-3, 4));
  const float side_u = sample.whole(1, 32);
  const float side_v = sample.whole(1, 32);
  return {u, u + side_u, v, v + side_v, depth_m, depth_m * (1 + sample.real(0, 0.3f))};
}

struct Sample {
  float u;
  float v;
  float depth_m;
};

/// Often one of the ends, where the bound is tight.
float whole_in(PixelSampler& sample, float lo, float hi) {
  const float end = sample.whole(0, 2);
  return end == 0 ? lo : end == 1 ? hi : sample.whole(static_cast<int>(lo), static_cast<int>(hi));
}

Sample random_pixel(PixelSampler& sample, const PixelBox& box) {
  const float end = sample.whole(0, 2);
  const float depth_m = end == 0   ? box.depth_lo_m
                        : end == 1 ? box.depth_hi_m
                                   : sample.real(box.depth_lo_m, box.depth_hi_m);
  return {whole_in(sample, box.u_lo, box.u_hi - 1), whole_in(sample, box.v_lo, box.v_hi - 1),
          depth_m};
}

TEST(LowerBound, IsNeverAboveTheComputedDistanceOfAnyPair) {
  PixelSampler sample;
  int tight = 0;
  for (int i = 0; i < 20000; ++i) {
    const Metric metric{sample.real(-30, 90), sample.real(-30, 90), 1 / sample.real(20, 90),
                        1 / sample.real(20, 90)};
    const PixelBox robot = random_box(sample);
    const PixelBox obstacle = random_box(sample);
    // The exact gap of some pair, as the search's best distance would be; or none at all.
    const float some_gap_m =
        depth_gap_m(robot.depth_lo_m, sample.real(obstacle.depth_lo_m, obstacle.depth_hi_m));
    const float max_gap_m = sample.whole(0, 3) == 0 ? HUGE_VALF : some_gap_m;
    const float bound_m2 = lower_bound_m2(metric, robot, obstacle, max_gap_m);
    for (int k = 0; k < 50; ++k) {
      const Sample r = random_pixel(sample, robot);
      const Sample o = random_pixel(sample, obstacle);
      if (o.depth_m - r.depth_m > max_gap_m) continue;
      const float squared_m2 =
          squared_distance_m2(metric, r.u, r.v, r.depth_m, o.u, o.v, o.depth_m);
      ASSERT_LE(bound_m2, squared_m2);
      tight += bound_m2 > 0.99f * squared_m2;
    }
  }
  EXPECT_GT(tight, 1000);
}

TEST(LowerBound, IsTheDistanceForBoxesOfOnePixelApart) {
  const Metric metric{10, 8, 0.1f, 0.2f};
  const PixelBox robot{3, 4, 8, 9, 2, 2};
  const PixelBox obstacle{7, 8, 8, 9, 3, 3};
  // The rows overlap, so only x and z are bounded.
  const auto v = pair_vector(metric, 3, 8, 2, 7, 8, 3);
  EXPECT_EQ(lower_bound_m2(metric, robot, obstacle, HUGE_VALF), v.x_m * v.x_m + v.z_m * v.z_m);
}

TEST(LowerBound, AnEmptyBoxNeverLiesBelowAnything) {
  const Metric metric{8, 8, 0.1f, 0.2f};
  const PixelBox robot{3, 4, 8, 9, 2, 2.5f};
  const PixelBox empty{8, 16, 8, 16, HUGE_VALF, -HUGE_VALF};
  EXPECT_FALSE(lower_bound_m2(metric, robot, empty, 1.0f) < HUGE_VALF);
  EXPECT_FALSE(lower_bound_m2(metric, empty, robot, 1.0f) < HUGE_VALF);
}

}  // namespace
}  // namespace berth
