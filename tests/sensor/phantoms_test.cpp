#include "berth/sensor/phantoms.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "berth/sensor/settings.hpp"
#include "sim/random.hpp"
#include "tests/support/thinned.hpp"

namespace berth::testing {
namespace {

constexpr double kRadius_m = SensorSettings{}.phantom_radius_m;

ObstacleImage all_kept(const DepthImage& depth_m) {
  ObstacleImage image;
  image.depth_m = depth_m;
  image.fate = Image<PixelFate>(depth_m.width(), depth_m.height(), PixelFate::obstacle);
  for (std::size_t i = 0; i < depth_m.pixels().size(); ++i) {
    PixelFate& fate = image.fate.pixels()[i];
    if (std::isnan(depth_m.pixels()[i])) fate = PixelFate::no_reading;
    ++image.count[static_cast<std::size_t>(fate)];
  }
  return image;
}

/// Some readings go to the robot, to its padding, or for another reason.
void drop_some(sim::Random& random, ObstacleImage& image) {
  constexpr PixelFate kFates[] = {PixelFate::robot, PixelFate::environment, PixelFate::padding,
                                  PixelFate::flying_patch};
  for (std::size_t i = 0; i < image.fate.pixels().size(); ++i) {
    PixelFate& fate = image.fate.pixels()[i];
    if (fate != PixelFate::obstacle || !random.chance(0.3)) continue;
    --image.count[static_cast<std::size_t>(fate)];
    fate = kFates[random.whole(0, 3)];
    ++image.count[static_cast<std::size_t>(fate)];
    image.depth_m.pixels()[i] = kNoDepth;
  }
}

/// The definition, pixel by pixel.
bool plainly_alone(const Camera& camera, const DepthImage& sensor_depth_m,
                   const ObstacleImage& image, int u, int v) {
  const double z_m = image.depth_m(u, v);
  const double across_px = std::sqrt(camera.fx_px * camera.fy_px) * kRadius_m / z_m;
  const double wanted = std::floor(0.25 * std::numbers::pi * across_px * across_px / 4);
  const double reach = std::min(8.0, std::min(camera.fx_px, camera.fy_px) * kRadius_m / z_m);
  int found = 0;
  for (int y = 0; y < image.depth_m.height(); ++y) {
    for (int x = 0; x < image.depth_m.width(); ++x) {
      if (std::abs(x - u) > reach || std::abs(y - v) > reach) continue;
      const PixelFate fate = image.fate(x, y);
      if (fate == PixelFate::robot || fate == PixelFate::environment) continue;
      const float there_m = is_kept(fate) ? image.depth_m(x, y) : sensor_depth_m(x, y);
      const double within_m = std::max(kRadius_m, 0.004 * z_m * z_m);
      found += std::abs(there_m - image.depth_m(u, v)) <= static_cast<float>(within_m);
    }
  }
  return found < std::min(wanted, 5.0);
}

TEST(Phantoms, AreThoseOfTheDefinition) {
  int dropped = 0;
  for (std::uint32_t seed = 0; seed < thinned(60u); ++seed) {
    sim::Random random(seed);
    Camera camera{random.whole(1, 40), random.whole(1, 30)};
    camera.fx_px = random(20, 300);
    camera.fy_px = camera.fx_px * random(0.9, 1.1);
    const double dense = random(0.05, 1);
    DepthImage depth_m(camera.width_px, camera.height_px, kNoDepth);
    for (float& z : depth_m.pixels()) {
      if (random.chance(dense)) z = static_cast<float>(random.whole(1, 4) + random(0, 0.06));
    }
    ObstacleImage before = all_kept(depth_m);
    if (random.chance(0.5)) drop_some(random, before);
    ObstacleImage after = before;
    PhantomWorkspace workspace;
    drop_phantoms(camera, depth_m, kRadius_m, workspace, after);
    std::int64_t speckle = 0;
    for (int v = 0; v < camera.height_px; ++v) {
      for (int u = 0; u < camera.width_px; ++u) {
        if (!is_kept(before.fate(u, v))) continue;
        const bool is_alone = plainly_alone(camera, depth_m, before, u, v);
        EXPECT_EQ(after.fate(u, v) == PixelFate::speckle, is_alone)
            << seed << ": " << u << " " << v;
        EXPECT_EQ(std::isnan(after.depth_m(u, v)), is_alone);
        speckle += is_alone;
      }
    }
    EXPECT_EQ(after.count_of(PixelFate::speckle), speckle);
    EXPECT_EQ(after.count_of(PixelFate::obstacle), before.count_of(PixelFate::obstacle) - speckle);
    dropped += static_cast<int>(speckle);
  }
  EXPECT_GT(dropped, thinned(100));
}

TEST(Phantoms, AFarWallInStepsOfTheSensorStays) {
  const Camera camera{64, 48, 525, 525, 31.5, 23.5};
  constexpr double kStep_per_m = 0.00285;
  for (const float wall_m : {3.0F, 4.0F, 5.0F}) {
    sim::Random random(3);
    DepthImage depth_m(64, 48, wall_m);
    for (float& z : depth_m.pixels()) {
      z += static_cast<float>(kStep_per_m * wall_m * wall_m * random.whole(0, 3));
    }
    ObstacleImage image = all_kept(depth_m);
    PhantomWorkspace workspace;
    drop_phantoms(camera, depth_m, kRadius_m, workspace, image);
    EXPECT_EQ(image.count_of(PixelFate::speckle), 0) << wall_m;
  }
}

TEST(Phantoms, AMixedPixelBetweenNearAndFarGoesAndIsToldOf) {
  const Camera camera{64, 48, 580, 580, 31.5, 23.5};
  DepthImage depth_m(64, 48, 3);
  for (int v = 0; v < 48; ++v) std::fill_n(depth_m.row(v), 32, 1.2F);
  depth_m(32, 20) = 1.9F;
  depth_m(32, 30) = 2.4F;
  ObstacleImage image = all_kept(depth_m);
  PhantomWorkspace workspace;
  drop_phantoms(camera, depth_m, kRadius_m, workspace, image);
  EXPECT_EQ(image.count_of(PixelFate::speckle), 2);
  EXPECT_EQ(image.fate(32, 20), PixelFate::speckle);
  EXPECT_EQ(image.fate(32, 30), PixelFate::speckle);
}

TEST(Phantoms, WhatPaddingLeavesOfAThingStays) {
  const Camera camera{64, 48, 580, 580, 31.5, 23.5};
  DepthImage depth_m(64, 48, 3);
  for (int v = 0; v < 48; ++v) std::fill_n(depth_m.row(v) + 20, 8, 1.2F);
  ObstacleImage image = all_kept(depth_m);
  for (int v = 0; v < 48; ++v) {
    for (int u = 20; u < 28; ++u) {
      if (u == 27 && v == 24) continue;
      image.fate(u, v) = PixelFate::padding;
      image.depth_m(u, v) = kNoDepth;
    }
  }
  PhantomWorkspace workspace;
  drop_phantoms(camera, depth_m, kRadius_m, workspace, image);
  EXPECT_EQ(image.fate(27, 24), PixelFate::obstacle);
  // The robot itself is no support.
  for (PixelFate& fate : image.fate.pixels()) {
    if (fate == PixelFate::padding) fate = PixelFate::robot;
  }
  drop_phantoms(camera, depth_m, kRadius_m, workspace, image);
  EXPECT_EQ(image.fate(27, 24), PixelFate::speckle);
}

/// A wall at 4 m, and before it a stick of a width and length, seen with noise and dropouts.
/// Returns which share of its readings is kept.
double kept_of_stick(double f_px, double z_m, double width_m, double length_m, std::uint32_t seed) {
  sim::Random random(seed);
  const Camera camera{160, 120, f_px, f_px, 79.5, 59.5};
  DepthImage depth_m(160, 120, 4);
  Image<std::uint8_t> is_stick(160, 120, 0);
  const double along = random(-std::numbers::pi, std::numbers::pi);
  const double off_m = random(-0.02, 0.02);
  int shown = 0;
  for (int v = 0; v < 120; ++v) {
    for (int u = 0; u < 160; ++u) {
      const double x = (u - camera.cx_px) * z_m / f_px, y = (v - camera.cy_px) * z_m / f_px;
      const double across_m = -std::sin(along) * x + std::cos(along) * y + off_m;
      const double down_m = std::cos(along) * x + std::sin(along) * y;
      double depth = 4;
      if (std::abs(across_m) <= width_m / 2 && std::abs(down_m) <= length_m / 2) {
        depth = z_m;
        is_stick(u, v) = 1;
      }
      depth += 0.0015 * depth * depth * random.gaussian();
      depth_m(u, v) = random.chance(0.02) ? kNoDepth : static_cast<float>(depth);
      if (is_stick(u, v) && !std::isnan(depth_m(u, v))) ++shown;
    }
  }
  ObstacleImage image = all_kept(depth_m);
  PhantomWorkspace workspace;
  drop_phantoms(camera, depth_m, kRadius_m, workspace, image);
  int kept = 0;
  for (int v = 0; v < 120; ++v) {
    for (int u = 0; u < 160; ++u) kept += is_stick(u, v) && !std::isnan(image.depth_m(u, v));
  }
  return shown == 0 ? 1 : static_cast<double>(kept) / shown;
}

TEST(Phantoms, RodsFingersAndCablesStay) {
  struct Stick {
    const char* name;
    double width_m, length_m;
  };
  for (const Stick& stick :
       {Stick{"rod", 0.01, 0.3}, Stick{"fingertip", 0.015, 0.07}, Stick{"cable", 0.005, 0.5}}) {
    for (const double f_px : {580.0, 290.0}) {
      for (const double z_m : {1.0, 2.0, 3.0}) {
        double kept = 0;
        constexpr int kTries = 20;
        for (std::uint32_t seed = 0; seed < kTries; ++seed) {
          kept += kept_of_stick(f_px, z_m, stick.width_m, stick.length_m, seed) / kTries;
        }
        EXPECT_GT(kept, 0.9) << stick.name << ", f " << f_px << ", " << z_m << " m";
      }
    }
  }
}

}  // namespace
}  // namespace berth::testing
