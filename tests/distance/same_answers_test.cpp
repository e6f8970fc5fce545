// What must not change an answer by more than the tolerance: instruction sets, threads, first
// guesses. And what must not change a bit of it: what others have asked before.
#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include "sim/random.hpp"
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

void expect_equal(const SpacePair& a, const SpacePair& b) {
  EXPECT_EQ(a.lower_bound_m, b.lower_bound_m);
  ASSERT_EQ(a.is_known(), b.is_known());
  if (!a.is_known()) return;
  EXPECT_EQ(a.distance_m, b.distance_m);
  EXPECT_EQ(a.robot_point_B_m, b.robot_point_B_m);
  EXPECT_EQ(a.obstacle_point_B_m, b.obstacle_point_B_m);
}

/// The points that both know; returns how many.
int expect_equal_fields(const LinkPatches& a, const LinkPatches& b) {
  int both = 0;
  for (const float distance_m : {0.1f, 0.5f, 1.0f}) {
    const mesh::FieldGrid& of_a = *a.field->grid_for(distance_m);
    const mesh::FieldGrid& of_b = *b.field->grid_for(distance_m);
    const std::array<int, 3> count = of_a.all().count;
    const auto points = static_cast<std::size_t>(count[0] * count[1] * count[2]);
    for (std::size_t i = 0; i < points; ++i) {
      if (of_a.squared_m2(i) == 0 || of_b.squared_m2(i) == 0) continue;
      ++both;
      EXPECT_EQ(of_a.squared_m2(i), of_b.squared_m2(i));
    }
  }
  return both;
}

/// A stream about a robot that nobody has asked of, and the same stream after and between requests
/// of others about that robot elsewhere, as another thread's are.
TEST(MeshSameAnswers, WhateverOthersHaveAsked) {
  int both = 0;
  for (std::uint32_t seed = 0; seed < thinned(20u); ++seed) {
    const MeshWorld world = world_of(seed);
    const PreparedWorld alone(world), shared(world);
    MeshWorkspace of_alone, of_shared;
    std::vector<WholeLinkDistance> out_alone, out_shared;
    sim::Random random(seed);
    RobotPose pose = world.pose;
    for (int i = 0; i < 20; ++i) {
      RobotPose elsewhere = pose;
      for (Pose& X_BL : elsewhere.X_BL) X_BL.translation() += sim::draw_point(random, 0.2);
      for (Pose& X_BL : pose.X_BL) {
        X_BL = X_BL * Eigen::Translation3d(sim::draw_point(random, 0.01)) *
               Eigen::AngleAxisd(random(-0.05, 0.05), Eigen::Vector3d::UnitZ());
      }
      MeshWorkspace of_others;
      std::vector<WholeLinkDistance> others;
      mesh_distances(shared.patches(), elsewhere, shared.space(), {2.0, kTolerance_m}, of_others,
                     others);
      mesh_distances(alone.patches(), pose, alone.space(), {1.0, kTolerance_m}, of_alone,
                     out_alone);
      mesh_distances(shared.patches(), pose, shared.space(), {1.0, kTolerance_m}, of_shared,
                     out_shared);
      for (std::size_t k = 0; k < out_alone.size(); ++k) {
        expect_equal(out_alone[k].occupied, out_shared[k].occupied);
        expect_equal(out_alone[k].nearest, out_shared[k].nearest);
      }
      if (HasFailure()) return;
    }
    for (std::size_t i = 0; i < alone.patches().links.size(); ++i) {
      both += expect_equal_fields(alone.patches().links[i], shared.patches().links[i]);
    }
    if (HasFailure()) return;
  }
  EXPECT_GT(both, thinned(2000));
}

}  // namespace
}  // namespace berth::testing
