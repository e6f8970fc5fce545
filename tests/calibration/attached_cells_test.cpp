// Some of the cells of build/release/lab/measure_calibration --attached.
#include <gtest/gtest.h>

#include "lab/calibration/attached.hpp"
#include "tests/calibration/arms.hpp"

namespace berth {
namespace {

lab::AttachedTrial try_arm(sim::DrawnKind kind, int poses, int cameras) {
  return lab::try_attached(bundled_arm().model, bundled_arm().meshes, kind, poses, cameras, 1);
}

TEST(AttachedCells, WhatIsShownIsFoundAndNothingOfTheRoom) {
  for (const auto kind : {sim::DrawnKind::tool, sim::DrawnKind::bent_tool}) {
    const lab::AttachedTrial trial = try_arm(kind, 5, 3);
    ASSERT_GE(trial.poses_shown, 3);
    EXPECT_TRUE(trial.is_found);
    EXPECT_GT(trial.precision, 0.7);
    EXPECT_GT(trial.recall, 0.95);
    EXPECT_EQ(trial.false_parts, 0);
    EXPECT_EQ(trial.room_points, 0);
  }
}

TEST(AttachedCells, ARobotThatCarriesNothingHasNoPart) {
  EXPECT_EQ(try_arm(sim::DrawnKind::bare, 5, 3).parts, 0);
}

}  // namespace
}  // namespace berth
