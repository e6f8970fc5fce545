// What must not change an answer by more than the tolerance: instruction sets, threads, first
// guesses.
#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include "tests/distance/agreement.hpp"
#include "tests/support/mesh_world.hpp"
#include "tests/support/only_target.hpp"
#include "tests/support/thinned.hpp"

namespace berth::testing {
namespace {

constexpr double kTolerance_m = 1e-3;

MeshWorld world_of(std::uint32_t seed) {
  MeshWorldSettings settings;
  settings.views = 1 + static_cast<int>(seed % 3);
  settings.width_px = 64;
  settings.height_px = 48;
  return draw_mesh_world(settings, 600 + seed);
}

void expect_same(const SpacePair& a, const SpacePair& b) {
  ASSERT_EQ(a.is_known(), b.is_known());
  if (!a.is_known()) return;
  expect_agree(a, b);
  EXPECT_LE(a.distance_m - a.lower_bound_m, kTolerance_m + 1e-6);
}

void expect_same(const std::vector<WholeLinkDistance>& a, const std::vector<WholeLinkDistance>& b) {
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i) {
    expect_same(a[i].occupied, b[i].occupied);
    expect_same(a[i].nearest, b[i].nearest);
  }
}

TEST(MeshSameAnswers, OnEveryInstructionSet) {
  for (std::uint32_t seed = 0; seed < thinned(6u); ++seed) {
    const MeshWorld world = world_of(seed);
    const auto best = PreparedWorld(world).ask({1.0, kTolerance_m});
    on_every_target([&](const char* target) {
      SCOPED_TRACE(target);
      expect_same(PreparedWorld(world).ask({1.0, kTolerance_m}), best);
    });
  }
}

TEST(MeshSameAnswers, WithAnyNumberOfThreads) {
  for (std::uint32_t seed = 0; seed < thinned(6u); ++seed) {
    const MeshWorld world = world_of(seed);
    const auto many = PreparedWorld(world).ask({1.0, kTolerance_m});
    for (const std::size_t threads : {1, 3}) {
      const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
      expect_same(PreparedWorld(world).ask({1.0, kTolerance_m}), many);
    }
  }
}

/// From the answer for other joint angles, and from one that makes no sense here.
TEST(MeshSameAnswers, FromAnyFirstGuess) {
  for (std::uint32_t seed = 0; seed < thinned(6u); ++seed) {
    const MeshWorld world = world_of(seed);
    const PreparedWorld prepared(world);
    const auto cold = prepared.ask({1.0, kTolerance_m});
    MeshWorkspace workspace;
    std::vector<WholeLinkDistance> out = cold;
    RobotPose moved = world.pose;
    for (Pose& X_BL : moved.X_BL) X_BL.translation().x() += 0.05;
    mesh_distances(prepared.patches(), moved, prepared.space(), {1.0, kTolerance_m}, workspace,
                   out);
    mesh_distances(prepared.patches(), world.pose, prepared.space(), {1.0, kTolerance_m}, workspace,
                   out);
    expect_same(out, cold);
    for (WholeLinkDistance& link : out) {
      link.occupied.camera = 5;
      link.occupied.obstacle_pixel = {1000, -3};
      link.nearest = link.occupied;
    }
    mesh_distances(prepared.patches(), world.pose, prepared.space(), {1.0, kTolerance_m}, workspace,
                   out);
    expect_same(out, cold);
  }
}

}  // namespace
}  // namespace berth::testing
