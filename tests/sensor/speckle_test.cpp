#include "berth/sensor/sensor_rules.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "tests/sensor/images.hpp"

namespace berth {
namespace {

ObstacleImage without_speckle(const DepthImage& depth_m, int speckle_px) {
  ObstacleImage image = kept_image(depth_m);
  SensorSettings settings;
  settings.speckle_px = speckle_px;
  SpeckleWorkspace workspace;
  drop_speckle(settings, workspace, image);
  return image;
}

/// A wall of 3 m with a patch of this size before it.
DepthImage wall_with_patch(int width_px, int height_px, float depth_m) {
  DepthImage image(30, 30, 3.0F);
  for (int v = 10; v < 10 + height_px; ++v) {
    for (int u = 10; u < 10 + width_px; ++u) image(u, v) = depth_m;
  }
  return image;
}

TEST(Speckle, IsABlobOfFewerPixels) {
  EXPECT_EQ(without_speckle(wall_with_patch(3, 2, 1), 7).fate(11, 11), PixelFate::speckle);
  EXPECT_TRUE(std::isnan(without_speckle(wall_with_patch(3, 2, 1), 7).depth_m(11, 11)));
  EXPECT_EQ(without_speckle(wall_with_patch(3, 2, 1), 6).fate(11, 11), PixelFate::obstacle);
}

TEST(Speckle, ARodOfTenMillimetresAtOneAndAHalfMetresStays) {
  // At a focal length of 400 px: 2.7 px wide; the part that is seen is 5 cm long, 13 px.
  EXPECT_EQ(without_speckle(wall_with_patch(2, 13, 1.5F), 20).fate(11, 20), PixelFate::obstacle);
}

TEST(Speckle, StepsUpToTheJumpJoin) {
  // The step is 0.03 m up to 1 m, and 0.25 m at 2.9 m.
  EXPECT_EQ(without_speckle(wall_with_patch(2, 2, 2.72F), 5).fate(10, 10), PixelFate::speckle);
  EXPECT_EQ(without_speckle(wall_with_patch(2, 2, 2.80F), 5).fate(10, 10), PixelFate::obstacle);
}

TEST(Speckle, WhatIsSmallAtTheImagesBorderIsDroppedLikeAnyOther) {
  DepthImage depth_m(10, 10, kNoDepth);
  depth_m(0, 0) = depth_m(9, 9) = 1;
  const ObstacleImage image = without_speckle(depth_m, 2);
  EXPECT_EQ(image.fate(0, 0), PixelFate::speckle);
  EXPECT_EQ(image.fate(9, 9), PixelFate::speckle);
}

/// The blob around a pixel, by trying all pairs of its pixels and the others again and again.
std::size_t plain_blob_size(const DepthImage& depth_m, Pixel start, float jump_at_1m_m) {
  std::vector<Pixel> blob{start};
  for (bool grows = true; grows;) {
    grows = false;
    for (int v = 0; v < depth_m.height(); ++v) {
      for (int u = 0; u < depth_m.width(); ++u) {
        if (std::isnan(depth_m(u, v)) || std::ranges::find(blob, Pixel{u, v}) != blob.end())
          continue;
        const bool joins = std::ranges::any_of(blob, [&](Pixel p) {
          const float a = depth_m(p.u, p.v);
          const float b = depth_m(u, v);
          const float nearer = std::min(a, b);
          return std::abs(p.u - u) <= 1 && std::abs(p.v - v) <= 1 &&
                 std::abs(a - b) <= jump_at_1m_m * std::max(1.0F, nearer * nearer);
        });
        if (!joins) continue;
        blob.push_back({u, v});
        grows = true;
      }
    }
  }
  return blob.size();
}

TEST(Speckle, AgreesWithItsDefinitionOnPatchyImages) {
  sim::Random random(1);
  int dropped = 0;
  for (int i = 0; i < 60; ++i) {
    SCOPED_TRACE(i);
    DepthImage depth_m = patchy_image(random);
    depth_m.resize(std::min(depth_m.width(), 14), std::min(depth_m.height(), 12), kNoDepth);
    for (float& z : depth_m.pixels()) {
      if (random.chance(0.4)) z = 0.9F + 0.025F * static_cast<float>(random.whole(0, 12));
    }
    const int speckle_px = random.whole(2, 12);
    const ObstacleImage image = without_speckle(depth_m, speckle_px);
    for (int v = 0; v < depth_m.height(); ++v) {
      for (int u = 0; u < depth_m.width(); ++u) {
        if (std::isnan(depth_m(u, v))) continue;
        const bool small =
            plain_blob_size(depth_m, {u, v}, 0.03F) < static_cast<std::size_t>(speckle_px);
        ASSERT_EQ(image.fate(u, v), small ? PixelFate::speckle : PixelFate::obstacle)
            << u << ", " << v;
        dropped += small;
      }
    }
  }
  EXPECT_GT(dropped, 300);
}

}  // namespace
}  // namespace berth
