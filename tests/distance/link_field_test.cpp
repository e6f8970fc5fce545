// A link's field beside the distances of its triangles.
#include "berth/distance/link_field.hpp"

#include <gtest/gtest.h>

#include <thread>
#include <vector>

#include "sim/random.hpp"

namespace berth::mesh {
namespace {

/// One triangle's corners, as LinkPatches has them.
std::array<std::vector<float>, 9> triangle() {
  std::array<std::vector<float>, 9> corners_m;
  const float at[9] = {0, 0, 0, 0.2F, 0, 0, 0, 0.3F, 0.1F};
  for (std::size_t i = 0; i < 9; ++i) corners_m[i] = {at[i]};
  return corners_m;
}

TEST(LinkField, ItsGridsAreTheFinerTheNearer) {
  const LinkField field(triangle());
  EXPECT_EQ(field.grid_for(0), nullptr);
  EXPECT_EQ(field.grid_for(std::nanf("")), nullptr);
  EXPECT_EQ(field.grid_for(100), nullptr);
  float edge_m = 0;
  for (float distance_m = LinkField::kNearest_m; distance_m < 1.15F; distance_m += 0.01F) {
    const FieldGrid* const grid = field.grid_for(distance_m);
    ASSERT_NE(grid, nullptr);
    EXPECT_GE(grid->edge_m(), edge_m);
    edge_m = grid->edge_m();
    // What a trilinear function may lack in the middle of a cell.
    EXPECT_LT(edge_m * edge_m * 3 / (8 * distance_m), 0.0007F) << distance_m;
  }
}

TEST(LinkField, ACellHoldsThePointsThatItIsToldFor) {
  const LinkField field(triangle());
  sim::Random random(3);
  for (int i = 0; i < 1000; ++i) {
    const auto distance_m = static_cast<float>(random(0.05, 1.1));
    const FieldGrid& grid = *field.grid_for(distance_m);
    const Eigen::Vector3f p_L_m =
        (distance_m * sim::draw_point(random, 1).normalized()).cast<float>();
    std::array<int, 3> cell;
    Eigen::Vector3f place;
    ASSERT_TRUE(grid.cell_of(p_L_m, cell, place)) << "what is so far from the link is in its grid";
    const Eigen::Vector3f again_m = grid.corner_L_m(cell, 0) + grid.edge_m() * place;
    EXPECT_LT((again_m - p_L_m).norm(), 2e-6F);
    EXPECT_GE(place.minCoeff(), 0);
    EXPECT_LE(place.maxCoeff(), 1);
    for (int corner = 1; corner < 8; ++corner) {
      EXPECT_NE(grid.corner(cell, corner), grid.corner(cell, corner - 1));
    }
  }
  std::array<int, 3> cell;
  Eigen::Vector3f place;
  EXPECT_FALSE(field.grid_for(0.1F)->cell_of({5, 0, 0}, cell, place));
  EXPECT_FALSE(field.grid_for(0.1F)->cell_of({-5, 0, 0}, cell, place));
  EXPECT_FALSE(field.grid_for(0.1F)->cell_of({0, std::nanf(""), 0}, cell, place));
}

TEST(LinkField, AnyNumberOfThreadsKeepPoints) {
  const LinkField field(triangle());
  const FieldGrid& grid = *field.grid_for(0.1F);
  std::vector<std::jthread> threads;
  for (int t = 0; t < 4; ++t) {
    threads.emplace_back([&grid] {
      for (std::size_t i = 0; i < 5000; ++i) {
        const float known = grid.squared_m2(i);
        EXPECT_TRUE(known == 0 || known == static_cast<float>(i + 1));
        grid.keep(i, static_cast<float>(i + 1));
      }
    });
  }
  threads.clear();
  for (std::size_t i = 0; i < 5000; ++i) EXPECT_EQ(grid.squared_m2(i), static_cast<float>(i + 1));
}

}  // namespace
}  // namespace berth::mesh
