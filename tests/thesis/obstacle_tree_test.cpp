#include "thesis/obstacle_tree.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "sim/random_images.hpp"

namespace berth {
namespace {

struct Range {
  float lo_m = HUGE_VALF;
  float hi_m = -HUGE_VALF;
};

Range range_of(const DepthImage& depth_m, int u_begin, int v_begin, int side_px) {
  Range range;
  for (int v = v_begin; v < std::min(depth_m.height(), v_begin + side_px); ++v) {
    for (int u = u_begin; u < std::min(depth_m.width(), u_begin + side_px); ++u) {
      if (std::isnan(depth_m(u, v))) continue;
      range.lo_m = std::min(range.lo_m, depth_m(u, v));
      range.hi_m = std::max(range.hi_m, depth_m(u, v));
    }
  }
  return range;
}

void expect_tree_of(const DepthImage& depth_m, const ObstacleTree& tree) {
  ASSERT_GE(tree.level_count, 1);
  EXPECT_EQ(tree.levels[tree.level_count - 1].nodes.size(), 1u);
  for (int l = 0; l < tree.level_count; ++l) {
    const ObstacleTree::Level& level = tree.levels[l];
    ASSERT_GE(level.columns * 4 * level.child_px, depth_m.width());
    ASSERT_GE(level.rows * 4 * level.child_px, depth_m.height());
    for (int n = 0; n < level.columns * level.rows; ++n) {
      for (int c = 0; c < ObstacleTree::kChildren; ++c) {
        const Range range =
            range_of(depth_m, (n % level.columns * 4 + c % 4) * level.child_px,
                     (n / level.columns * 4 + c / 4) * level.child_px, level.child_px);
        EXPECT_EQ(level.nodes[n].depth_lo_m[c], range.lo_m);
        EXPECT_EQ(level.nodes[n].depth_hi_m[c], range.hi_m);
      }
    }
  }
}

TEST(ObstacleTree, EveryChildHasItsPixelsDepthRange) {
  ObstacleTree tree;
  const int sizes[][2] = {{1, 1}, {640, 480}, {8, 8}, {33, 17}, {129, 65}, {32, 32}, {2100, 9}};
  for (const auto& size : sizes) {
    SCOPED_TRACE(size[0]);
    const auto images = sim::random_images(3, size[0], size[1], 2);
    build_obstacle_tree(images.obstacle_depth_m, tree);
    expect_tree_of(images.obstacle_depth_m, tree);
  }
}

TEST(ObstacleTree, AnImageWithoutReadingsIsEmpty) {
  ObstacleTree tree;
  const DepthImage depth_m(40, 30, kNoDepth);
  build_obstacle_tree(depth_m, tree);
  expect_tree_of(depth_m, tree);
  build_obstacle_tree(DepthImage(), tree);
  EXPECT_EQ(tree.level_count, 1);
}

}  // namespace
}  // namespace berth
