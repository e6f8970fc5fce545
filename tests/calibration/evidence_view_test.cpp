// What one image says of a place.
#include "berth/calibration/evidence_view.hpp"

#include <gtest/gtest.h>

#include "berth/fit/robot_pixels.hpp"
#include "tests/calibration/evidence_images.hpp"

namespace berth {
namespace {

TEST(EvidenceView, APlaceIsFreeWhereAllAroundItIsFartherByTheUncertainty) {
  const EvidenceView view = plate_view();
  EXPECT_TRUE(sees_free(view, {0, 0, kPlate_m - 0.015}));
  EXPECT_FALSE(sees_free(view, {0, 0, kPlate_m - 0.005}));
  EXPECT_FALSE(sees_free(view, {0, 0, kPlate_m + 0.1})) << "hidden";
  EXPECT_TRUE(sees_free(view, {0.125, 0, kPlate_m})) << "beside the plate";
  EXPECT_FALSE(sees_free(view, {0.104, 0, kPlate_m})) << "nearer beside it than the uncertainty";
  EXPECT_FALSE(sees_free(view, {0, 0, -1})) << "behind the camera";
  EXPECT_FALSE(sees_free(view, {5, 0, 1})) << "outside of the image";
}

TEST(EvidenceView, APlaceWithoutAReadingIsNotFree) {
  EvidenceView view = plate_view();
  const Eigen::Vector3d p_B_m(0.2, 0, kPlate_m);
  EXPECT_TRUE(sees_free(view, p_B_m));
  const Pixel at = *pixel_of(view.camera, p_B_m);
  view.depth_m(at.u, at.v) = kNoDepth;
  EXPECT_FALSE(sees_free(view, p_B_m));
}

TEST(EvidenceView, WhatMovesIsSeenWithinTheUncertainty) {
  EvidenceView view = plate_view();
  EXPECT_TRUE(sees_moving(view, {0, 0, kPlate_m + 0.008}));
  EXPECT_FALSE(sees_moving(view, {0, 0, kPlate_m + 0.012}));
  EXPECT_FALSE(sees_moving(view, {0.5, 0, kWall_m})) << "the wall is fixed";
}

TEST(EvidenceView, ACameraLooksIntoWhatIsBeforeItsReadingsAndIntoTheRoom) {
  EvidenceView view = plate_view();
  EXPECT_TRUE(may_hide(view, {0, 0, kPlate_m + 0.001})) << "behind what moves";
  EXPECT_FALSE(may_hide(view, {0, 0, kPlate_m - 0.001})) << "before it";
  EXPECT_FALSE(may_hide(view, {0.104, 0, kPlate_m})) << "before the wall, close to the plate";
  EXPECT_TRUE(may_hide(view, {0.5, 0, kWall_m + 0.012})) << "behind the wall";
  EXPECT_FALSE(may_hide(view, {0.5, 0, kWall_m + 0.008})) << "in the wall's own surface";
  EXPECT_TRUE(may_hide(view, {0, 0, -1})) << "behind the camera";
  EXPECT_TRUE(may_hide(view, {5, 0, 1})) << "outside of the image";
  view.depth_m(80, 60) = kNoDepth;
  EXPECT_TRUE(may_hide(view, point_at(view.camera, 80, 60, 0.5F))) << "no reading";
}

/// Two images of one camera: the plate was there, and then it was not.
std::vector<EvidenceView> plate_that_goes() {
  std::vector<EvidenceView> views(2, plate_view());
  for (int v = 0; v < 120; ++v) {
    for (int u = 0; u < 160; ++u) {
      views[0].kind(u, v) = ReadingKind::fixed;
      views[1].depth_m(u, v) = static_cast<float>(kWall_m);
      views[1].kind(u, v) = ReadingKind::fixed;
    }
  }
  return views;
}

RigidGroup group_that_reaches(double far_m) {
  RigidGroup group;
  group.reach_L_m.extend(Eigen::Vector3d(-1, -1, 0));
  group.reach_L_m.extend(Eigen::Vector3d(1, 1, far_m));
  return group;
}

TEST(FindMoving, WhatComesAndGoesMovesAndWhatStaysDoesNot) {
  std::vector<EvidenceView> views = plate_that_goes();
  views[0].kind(70, 60) = ReadingKind::beside;
  views[0].kind(71, 60) = ReadingKind::robot;
  find_moving({group_that_reaches(3)}, views);
  EXPECT_EQ(views[0].kind(80, 60), ReadingKind::moving);
  EXPECT_EQ(views[0].kind(70, 60), ReadingKind::moving_beside);
  EXPECT_EQ(views[0].kind(71, 60), ReadingKind::robot);
  EXPECT_EQ(views[0].kind(10, 10), ReadingKind::fixed);
  EXPECT_EQ(views[1].kind(80, 60), ReadingKind::fixed);
}

TEST(FindMoving, OutOfReachNothingIsLookedAt) {
  std::vector<EvidenceView> views = plate_that_goes();
  find_moving({group_that_reaches(0.9)}, views);
  EXPECT_EQ(views[0].kind(80, 60), ReadingKind::fixed);
}

TEST(FindMoving, AnotherCameraTellsNothing) {
  std::vector<EvidenceView> views = plate_that_goes();
  views[1].camera_index = 1;
  find_moving({group_that_reaches(3)}, views);
  EXPECT_EQ(views[0].kind(80, 60), ReadingKind::fixed);
}

}  // namespace
}  // namespace berth
