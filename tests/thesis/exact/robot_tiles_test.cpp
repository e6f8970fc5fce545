#include "thesis/exact/robot_tiles.hpp"

#include <gtest/gtest.h>

#include "sim/random_images.hpp"

namespace berth {
namespace {

/// Puts the pixels of a link's tiles back into an image, and checks that each lies in its boxes.
void draw_link(const RobotImage& robot, const RobotTiles& tiles, LinkId id, RobotImage& out) {
  for (int n = tiles.links[id - 1].last_node; n >= 0; n = tiles.nodes[n].next) {
    const RobotTiles::Node& node = tiles.nodes[n];
    for (int t = 0; t < node.tile_count; ++t) {
      const RobotTiles::Tile& tile = tiles.tiles[node.tile[t]];
      for (int i = 0; i < kTilePixels; ++i) {
        if ((tile.bits >> i & 1) == 0) continue;
        const auto u = static_cast<float>(tile.u + i % 8);
        const auto v = static_cast<float>(tile.v + i / 8);
        const float z = robot.depth_m(tile.u + i % 8, tile.v + i / 8);
        EXPECT_TRUE(node.u_lo[t] <= u && u + 1 <= node.u_hi[t]);
        EXPECT_TRUE(node.v_lo[t] <= v && v + 1 <= node.v_hi[t]);
        EXPECT_TRUE(node.depth_lo_m[t] <= z && z <= node.depth_hi_m[t]);
        EXPECT_TRUE(node.box.u_lo <= u && u + 1 <= node.box.u_hi);
        EXPECT_TRUE(node.box.v_lo <= v && v + 1 <= node.box.v_hi);
        EXPECT_TRUE(node.box.depth_lo_m <= z && z <= node.box.depth_hi_m);
        EXPECT_EQ(out.link_id(static_cast<int>(u), static_cast<int>(v)), kNoLink);
        out.link_id(static_cast<int>(u), static_cast<int>(v)) = id;
        out.depth_m(static_cast<int>(u), static_cast<int>(v)) = z;
      }
    }
  }
}

void expect_all_pixels(const RobotImage& robot, int link_count, RobotTiles& tiles) {
  const int width = robot.depth_m.width();
  const int height = robot.depth_m.height();
  build_robot_tiles(robot, link_count, tiles);
  RobotImage drawn = sim::empty_images(width, height, 0).robot;
  int pixels = 0;
  for (int id = 1; id <= link_count; ++id) {
    draw_link(robot, tiles, static_cast<LinkId>(id), drawn);
    pixels += tiles.links[id - 1].pixels;
  }
  int expected = 0;
  for (int v = 0; v < height; ++v) {
    for (int u = 0; u < width; ++u) {
      const bool evaluated =
          robot.link_id(u, v) != kNoLink && robot.link_id(u, v) != kEnvironmentLink;
      EXPECT_EQ(drawn.link_id(u, v), evaluated ? robot.link_id(u, v) : kNoLink);
      if (evaluated) {
        EXPECT_EQ(drawn.depth_m(u, v), robot.depth_m(u, v));
      }
      expected += evaluated;
    }
  }
  EXPECT_EQ(pixels, expected);
}

TEST(RobotTiles, HoldEveryPixelOnceUnderItsLink) {
  RobotTiles tiles;
  const int sizes[][2] = {{320, 240}, {1, 1}, {33, 17}, {129, 65}, {9, 300}};
  for (const auto& size : sizes) {
    SCOPED_TRACE(size[0]);
    auto images = sim::random_images(5, size[0], size[1], 9);
    images.robot.link_id(0, 0) = kEnvironmentLink;
    images.robot.depth_m(0, 0) = 1;
    expect_all_pixels(images.robot, 9, tiles);
  }
}

TEST(RobotTiles, ATileWithADifferentLinkAtEveryPixelIsSortedOut) {
  auto images = sim::empty_images(8, 8, 64);
  for (int i = 0; i < 64; ++i) {
    images.robot.link_id(i % 8, i / 8) = static_cast<LinkId>(1 + i);
    images.robot.depth_m(i % 8, i / 8) = 1 + 0.01f * static_cast<float>(i);
  }
  RobotTiles tiles;
  expect_all_pixels(images.robot, 64, tiles);
}

TEST(RobotTiles, BoxesAreTight) {
  auto images = sim::empty_images(64, 64, 1);
  for (const Pixel p : {Pixel{34, 41}, Pixel{37, 46}}) {
    images.robot.link_id(p.u, p.v) = 1;
    images.robot.depth_m(p.u, p.v) = p.u == 34 ? 1.5f : 1.25f;
  }
  RobotTiles tiles;
  build_robot_tiles(images.robot, 1, tiles);
  ASSERT_EQ(tiles.nodes.size(), 1u);
  EXPECT_EQ(tiles.nodes[0].tile_count, 1);
  const PixelBox& box = tiles.nodes[0].box;
  EXPECT_EQ(box.u_lo, 34);
  EXPECT_EQ(box.u_hi, 38);
  EXPECT_EQ(box.v_lo, 41);
  EXPECT_EQ(box.v_hi, 47);
  EXPECT_EQ(box.depth_lo_m, 1.25f);
  EXPECT_EQ(box.depth_hi_m, 1.5f);
}

}  // namespace
}  // namespace berth
