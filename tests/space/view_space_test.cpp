#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <span>
#include <utility>

#include "sim/plain_closing.hpp"
#include "sim/plain_hiding.hpp"
#include "sim/random.hpp"
#include "tests/space/plain_view_space.hpp"
#include "tests/support/only_target.hpp"

namespace berth::testing {
namespace {

/// Steps in depth, holes alone and in patches, and every fate.
void draw(sim::Random& random, int width, int height, double holes, DepthImage& sensor_depth_m,
          ObstacleImage& obstacles, DepthImage& environment_back_m) {
  sensor_depth_m.resize(width, height, kNoDepth);
  obstacles.depth_m.resize(width, height, kNoDepth);
  environment_back_m.resize(width, height, kNoDepth);
  obstacles.fate.resize(width, height, PixelFate::obstacle);
  const bool any_fate = random.chance(0.5);
  for (int v = 0; v < height; ++v) {
    for (int u = 0; u < width; ++u) {
      const bool is_patch = holes > 0 && (u / 6 + v / 5) % 4 == 0;
      const double depth_m =
          (u / 5 + v / 3) % 3 * (random.chance(0.02) ? 20 : 1) + random(0.01, 0.04);
      if (!is_patch && !random.chance(holes)) sensor_depth_m(u, v) = static_cast<float>(depth_m);
      if (random.chance(0.8)) {
        environment_back_m(u, v) = static_cast<float>(depth_m + random(-0.1, 0.5));
      }
      obstacles.fate(u, v) = static_cast<PixelFate>(
          any_fate || random.chance(0.1) ? random.whole(0, kPixelFateCount - 1) : 0);
      ++obstacles.count[static_cast<std::size_t>(obstacles.fate(u, v))];
      if (any_fate ? random.chance(0.5) : obstacles.fate(u, v) == PixelFate::obstacle) {
        obstacles.depth_m(u, v) = sensor_depth_m(u, v) - (any_fate ? 0.01f : 0.0f);
      }
      if (any_fate && random.chance(0.1)) obstacles.depth_m(u, v) = 1.5f;
    }
  }
}

void expect_same(const DepthWindows& a, const DepthWindows& b) {
  ASSERT_EQ(a.level_count, b.level_count);
  for (int i = 0; i < a.level_count; ++i) {
    EXPECT_EQ(a.levels[i].step_px, b.levels[i].step_px);
    EXPECT_EQ(a.levels[i].side_px, b.levels[i].side_px);
    EXPECT_EQ(a.levels[i].columns, b.levels[i].columns);
    // The fast one has a number more.
    EXPECT_TRUE(std::ranges::equal(std::span(a.levels[i].least).first(b.levels[i].least.size()),
                                   b.levels[i].least));
  }
}

void expect_same(const UnitImage& found, const DepthImage& plain_m) {
  ASSERT_EQ(found.pixels().size(), plain_m.pixels().size());
  for (std::size_t i = 0; i < found.pixels().size(); ++i) {
    ASSERT_EQ(in_metres(found.pixels()[i]), plain_m.pixels()[i]) << i;
  }
}

void expect_same(const DepthCells& a, const DepthCells& b) {
  ASSERT_EQ(a.level_count, b.level_count);
  for (int i = 0; i < a.level_count; ++i) {
    ASSERT_EQ(a.levels[i].nodes.size(), b.levels[i].nodes.size());
    for (std::size_t k = 0; k < a.levels[i].nodes.size(); ++k) {
      for (int c = 0; c < 2 * DepthCells::kChildren; ++c) {
        const int half = c / DepthCells::kChildren, child = c % DepthCells::kChildren;
        const DepthCells::Node &x = a.levels[i].nodes[k], &y = b.levels[i].nodes[k];
        ASSERT_EQ(x.lo_m[half][child], y.lo_m[half][child]) << k << " " << c;
        ASSERT_EQ(x.hi_m[half][child], y.hi_m[half][child]) << k << " " << c;
      }
    }
  }
}

void expect_that_of_the_plain_way() {
  sim::Random random(5);
  const std::pair<int, int> sizes[] = {{1, 1},  {2, 9},   {7, 5},   {17, 3},  {18, 1},  {18, 18},
                                       {19, 2}, {33, 20}, {64, 48}, {71, 37}, {129, 9}, {130, 70}};
  CameraSpace fast;
  for (const auto& [width, height] : sizes) {
    for (const double holes : {0.0, 0.05, 0.4, 1.0}) {
      for (const NoReading no_reading : kNoReadings) {
        SCOPED_TRACE(std::to_string(width) + " x " + std::to_string(height) + ", holes " +
                     std::to_string(holes));
        DepthImage sensor_depth_m, environment_back_m, own_m, free_m;
        ObstacleImage obstacles;
        draw(random, width, height, holes, sensor_depth_m, obstacles, environment_back_m);
        SpaceSettings settings;
        settings.no_reading = no_reading;
        Camera camera{};
        camera.width_px = width;
        camera.height_px = height;
        camera.fx_px = random(40, 300);
        camera.fy_px = random(40, 300);
        build_camera_space(camera, sensor_depth_m, obstacles, {.back_m = environment_back_m},
                           settings, fast);
        plain_own_free_depth(sensor_depth_m, obstacles, environment_back_m, settings, own_m);
        const double told_m = sim::plainly_told_m(settings, camera);
        own_m = sim::plainly_freed_beside_robot(camera, sensor_depth_m, obstacles.depth_m,
                                                obstacles.fate, own_m, told_m);
        own_m = sim::plainly_closed(camera, own_m, told_m);
        plain_free_depth_of(own_m, free_m);
        expect_same(fast.own_free_depth, own_m);
        for (std::size_t i = 0; i < own_m.pixels().size(); ++i) {
          const float sensed_m = sensor_depth_m.pixels()[i];
          const float found_m = in_metres(fast.sensor_depth.pixels()[i]);
          ASSERT_EQ(found_m, std::isnan(sensed_m) ? HUGE_VALF : sim::plainly_counted(sensed_m));
        }
        DepthCells cells;
        plain_depth_cells(obstacles.depth_m, cells);
        expect_same(fast.cells, cells);
        DepthWindows windows;
        plain_depth_windows(sim::plainly_hidden_from(camera, sensor_depth_m, obstacles.depth_m,
                                                     obstacles.fate, own_m, settings),
                            windows);
        expect_same(fast.hidden_depth, windows);
        plain_depth_windows(free_m, windows);
        expect_same(fast.free_depth, windows);
      }
    }
  }
}

TEST(CameraSpace, IsToTheBitThatOfThePlainWay) {
  on_every_target([](const char* target) {
    SCOPED_TRACE(target);
    expect_that_of_the_plain_way();
  });
}

}  // namespace
}  // namespace berth::testing
