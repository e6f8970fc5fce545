#include "berth/sensor/average.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "tests/sensor/images.hpp"
#include "tests/support/same_bits.hpp"

namespace berth {
namespace {

/// One pixel through several frames; NaN where it showed no obstacle.
std::vector<ObstacleImage> average_of(const std::vector<float>& readings_m, int frames) {
  SensorSettings settings;
  settings.average_frames = frames;
  ReadingHistory history;
  std::vector<ObstacleImage> images;
  for (const float z : readings_m) {
    images.push_back(kept_image(DepthImage(1, 1, z)));
    average_readings(settings, history, images.back());
  }
  return images;
}

float last_m(const std::vector<float>& readings_m, int frames) {
  return average_of(readings_m, frames).back().depth_m(0, 0);
}

TEST(Average, MovesAReadingToANearerMean) {
  EXPECT_FLOAT_EQ(last_m({1.0F, 1.0F, 1.012F}, 3), 1.004F);
  EXPECT_EQ(average_of({1.0F, 1.012F}, 3).back().fate(0, 0), PixelFate::averaged);
}

TEST(Average, NeverMovesAReadingAway) {
  EXPECT_EQ(last_m({1.012F, 1.012F, 1.0F}, 3), 1.0F);
  EXPECT_EQ(average_of({1.012F, 1.0F}, 3).back().fate(0, 0), PixelFate::obstacle);
}

TEST(Average, GoesBackSoManyFrames) {
  EXPECT_FLOAT_EQ(last_m({0.99F, 1.0F, 1.01F}, 2), 1.005F);
  EXPECT_FLOAT_EQ(last_m({0.99F, 1.0F, 1.01F}, 3), 1.0F);
}

TEST(Average, BeginsAnewAfterAJumpAndAfterAGap) {
  EXPECT_EQ(last_m({1.0F, 1.5F}, 3), 1.5F);
  EXPECT_EQ(last_m({1.49F, 1.0F, 1.5F}, 3), 1.5F);
  EXPECT_EQ(last_m({1.49F, kNoDepth, 1.5F}, 3), 1.5F);
  EXPECT_EQ(last_m({1.0F, 0.5F}, 3), 0.5F);
}

TEST(Average, ForgetsImagesOfAnotherSize) {
  SensorSettings settings;
  settings.average_frames = 4;
  ReadingHistory history;
  ObstacleImage small = kept_image(DepthImage(2, 2, 1.0F));
  average_readings(settings, history, small);
  ObstacleImage large = kept_image(DepthImage(3, 2, 1.01F));
  average_readings(settings, history, large);
  EXPECT_TRUE(same_bits(large.depth_m, DepthImage(3, 2, 1.01F)));
}

/// From the definition, with all frames at hand.
float plain_average_m(const std::vector<DepthImage>& frames, std::size_t i, std::size_t pixel,
                      const SensorSettings& settings) {
  const float now = frames[i].pixels()[pixel];
  const float noise_m = static_cast<float>(settings.noise_m) * std::max(1.0F, now * now);
  float sum = now;
  int count = 1;
  for (std::size_t k = i; k-- > 0 && count < settings.average_frames; ++count) {
    const float z = frames[k].pixels()[pixel];
    if (std::isnan(z) || std::abs(z - now) > noise_m) break;
    sum += z;
  }
  return std::min(now, sum / static_cast<float>(count));
}

TEST(Average, AgreesWithItsDefinitionAndStaysWithinTheNoise) {
  sim::Random random(2);
  int moved = 0;
  for (int run = 0; run < 20; ++run) {
    SensorSettings settings;
    settings.average_frames = random.whole(2, 7);
    settings.noise_m = random(0.005, 0.05);
    ReadingHistory history;
    std::vector<DepthImage> frames;
    for (std::size_t i = 0; i < 20; ++i) {
      DepthImage depth_m(9, 7, kNoDepth);
      for (float& z : depth_m.pixels()) {
        const double surface_m = random.chance(0.1) ? 0.8 : 2.0;
        if (!random.chance(0.05)) z = static_cast<float>(surface_m + random(-0.03, 0.03));
      }
      frames.push_back(depth_m);
      ObstacleImage image = kept_image(depth_m);
      average_readings(settings, history, image);
      for (std::size_t p = 0; p < depth_m.pixels().size(); ++p) {
        const float z = depth_m.pixels()[p];
        if (std::isnan(z)) continue;
        const float found = image.depth_m.pixels()[p];
        ASSERT_EQ(found, plain_average_m(frames, i, p, settings));
        ASSERT_LE(found, z);
        ASSERT_GE(found, z - settings.noise_m * std::max(1.0F, z * z) - 1e-6);
        moved += found < z;
      }
    }
  }
  EXPECT_GT(moved, 2000);
}

}  // namespace
}  // namespace berth
