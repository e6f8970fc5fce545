#include "berth/fit/fit_rows.hpp"

#include <gtest/gtest.h>

#include "tests/fit/hand_made_image.hpp"

namespace berth {
namespace {

constexpr PixelRect kPlate{40, 30, 80, 60};
/// A pixel's width at the plate.
constexpr double kPixel_m = 0.01;

/// Of a plate that stands `by_px` to the right, wider by `wider_px` on each side.
DepthImage moved_plate(int by_px, int wider_px = 0) {
  return sensed(plate({kPlate.u_begin + by_px - wider_px, kPlate.v_begin - wider_px,
                       kPlate.u_end + by_px + wider_px, kPlate.v_end + wider_px})
                    .robot);
}

struct Found {
  OutlineCount count;
  std::vector<FitRow> rows;
};

Found look(const RobotImage& robot, const DepthImage& depth_m, const CameraEstimate& estimate = {},
           int step = 1) {
  Found found;
  found.count =
      append_outline_rows(kHandMadeCamera, depth_m, robot, estimate, step, {10, 0.05}, found.rows);
  return found;
}

/// Of the plate's upright edge on this side, well away from its corners.
std::vector<FitRow> side_rows(const std::vector<FitRow>& rows, bool is_right) {
  std::vector<FitRow> side;
  for (const FitRow& row : rows) {
    const ImagePoint at = project(kHandMadeCamera, row.p_C_m);
    const double edge = is_right ? kPlate.u_end - 0.5 : kPlate.u_begin - 0.5;
    if (std::abs(at.u - edge) < 0.01 && at.v > kPlate.v_begin + 4 && at.v < kPlate.v_end - 5) {
      side.push_back(row);
    }
  }
  return side;
}

TEST(OutlineRows, AShiftByKPixelsIsTheResidual) {
  for (int k = -8; k <= 8; ++k) {
    SCOPED_TRACE(k);
    const Found found = look(plate(kPlate).robot, moved_plate(k));
    for (const bool is_right : {false, true}) {
      const std::vector<FitRow> side = side_rows(found.rows, is_right);
      EXPECT_GE(side.size(), 20U);
      for (const FitRow& row : side) {
        EXPECT_NEAR(row.residual_m, (is_right ? k : -k) * kPixel_m, 1e-6);
        EXPECT_EQ(row.link, 1);
        // The model has to go there.
        EXPECT_NEAR(row.residual_m + row.per_move.dot(Eigen::Vector3d(k * kPixel_m, 0, 0)), 0,
                    1e-6);
        EXPECT_NEAR(row.per_move.y(), 0, 1e-6);
      }
    }
  }
}

TEST(OutlineRows, AModelThatComesNearerGrowsInTheImage) {
  const Found found = look(plate(kPlate).robot, moved_plate(0));
  for (const FitRow& row : side_rows(found.rows, true)) {
    // u - cx = fx x / z, so that du/dz = -(u - cx) / z.
    EXPECT_NEAR(row.per_move.z(), (kPlate.u_end - 0.5 - kHandMadeCamera.cx_px) * kPixel_m, 1e-6);
  }
}

TEST(OutlineRows, FarOutlinesAreNotFound) {
  const Found found = look(plate(kPlate).robot, moved_plate(14));
  EXPECT_TRUE(side_rows(found.rows, true).empty());
  EXPECT_TRUE(side_rows(found.rows, false).empty());
  EXPECT_GE(found.count.places, 2 * (40 + 30) - 30);
  EXPECT_LT(found.count.found, found.count.places);
  EXPECT_EQ(found.count.found, static_cast<int>(found.rows.size()));
}

TEST(OutlineRows, WhatStandsBeforeTheOutlineGivesNone) {
  DepthImage depth_m = moved_plate(0);
  for (int v = 0; v < kHandMadeCamera.height_px; ++v) {
    for (int u = 78; u < 84; ++u) depth_m(u, v) = 0.5F;
  }
  const Found found = look(plate(kPlate).robot, depth_m);
  EXPECT_TRUE(side_rows(found.rows, true).empty());
  EXPECT_FALSE(side_rows(found.rows, false).empty());
  // Nor where it begins right beside it.
  depth_m = moved_plate(0);
  for (int v = 0; v < kHandMadeCamera.height_px; ++v) depth_m(80, v) = 0.5F;
  EXPECT_TRUE(side_rows(look(plate(kPlate).robot, depth_m).rows, true).empty());
}

TEST(OutlineRows, NoReadingIsNoRobot) {
  const Found found = look(plate(kPlate).robot, sensed(plate(kPlate).robot, kNoDepth));
  ASSERT_FALSE(side_rows(found.rows, true).empty());
  for (const FitRow& row : side_rows(found.rows, true)) EXPECT_NEAR(row.residual_m, 0, 1e-9);
}

TEST(OutlineRows, WhatIsCloseBehindMayBeTheRobotItself) {
  HandMadeImage image = plate(kPlate);
  add_plate({80, 30, 100, 60}, 1.0F + 0.03F, 2, image);
  EXPECT_TRUE(side_rows(look(image.robot, sensed(image.robot)).rows, true).empty());
  add_plate({80, 30, 100, 60}, 1.0F + 0.10F, 2, image);
  EXPECT_FALSE(side_rows(look(image.robot, sensed(image.robot)).rows, true).empty());
}

TEST(OutlineRows, EnvironmentHasNoOutline) {
  HandMadeImage image = plate(kPlate);
  add_plate(kPlate, 1.0F, kEnvironmentLink, image);
  const Found found = look(image.robot, sensed(image.robot));
  EXPECT_EQ(found.count.places, 0);
  EXPECT_TRUE(found.rows.empty());
}

TEST(OutlineRows, TheDilationIsTakenOffInTheSensorsPixels) {
  const RobotImage robot = plate(kPlate).robot;
  const DepthImage wider = moved_plate(0, 3);
  for (const int step : {1, 3}) {
    const CameraEstimate estimate{.dilation_px = 3.0 * step};
    for (const FitRow& row : look(robot, wider, estimate, step).rows) {
      const bool is_side =
          std::abs(std::abs(row.per_move.dot(Eigen::Vector3d::UnitX())) - 1) < 1e-6;
      EXPECT_TRUE(!is_side || std::abs(row.residual_m) < 1e-6) << row.residual_m;
      EXPECT_NEAR(row.per_dilation, -kPixel_m / step, 1e-9);
    }
  }
}

TEST(OutlineRows, ReadingsAreTakenAsTheEstimateCorrectsThem) {
  DepthImage depth_m = moved_plate(0);
  for (float& z_m : depth_m.pixels()) z_m = (z_m - 0.1F) / 1.2F;
  EXPECT_TRUE(side_rows(look(plate(kPlate).robot, depth_m).rows, true).empty());
  const CameraEstimate estimate{.depth_offset_m = 0.1, .depth_scale = 1.2};
  EXPECT_FALSE(side_rows(look(plate(kPlate).robot, depth_m, estimate).rows, true).empty());
}

}  // namespace
}  // namespace berth
