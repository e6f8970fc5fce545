// Some of the cells of build/release/lab/measure_calibration --attached.
#include <gtest/gtest.h>

#include "lab/calibration/attached.hpp"
#include "tests/calibration/arms.hpp"

namespace berth {
namespace {

lab::AttachedTrial try_arm(sim::DrawnKind kind, int poses, int cameras) {
  return lab::try_attached(coarse_arm().model, coarse_arm().meshes, kind, poses, cameras, 1);
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

/// Each of these had a part where the share of what is explained was not asked for.
TEST(AttachedCells, WhatMovesOnItsOwnBesideTheRobotIsNoPartAndIsTold) {
  struct Case {
    sim::DrawnCompany company;
    int poses, cameras;
    std::uint32_t seed;
  };
  for (const Case& one :
       {Case{sim::DrawnCompany::follower, 5, 1, 1}, Case{sim::DrawnCompany::guide, 8, 2, 1},
        Case{sim::DrawnCompany::cart, 5, 1, 1}}) {
    SCOPED_TRACE(static_cast<int>(one.company));
    const AttachedParts found = lab::try_company(coarse_arm().model, coarse_arm().meshes,
                                                 one.company, one.poses, one.cameras, one.seed);
    EXPECT_TRUE(found.parts.empty());
    EXPECT_TRUE(found.refused.ends_with(
        "% of the readings that come and go near it fit none of its links; expected images in "
        "which nothing else moves"))
        << found.refused;
  }
}

}  // namespace
}  // namespace berth
