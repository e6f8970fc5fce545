#include "berth/fit/fit_rows.hpp"

#include <gtest/gtest.h>

#include "tests/fit/hand_made_image.hpp"

namespace berth {
namespace {

std::vector<FitRow> rows_of(const RobotImage& robot, const DepthImage& depth_m,
                            const CameraEstimate& estimate = {},
                            const DepthRowLimits& limits = {}) {
  std::vector<FitRow> rows;
  append_depth_rows(kHandMadeCamera, depth_m, robot, estimate, limits, rows);
  return rows;
}

constexpr PixelRect kFacing{30, 20, 70, 50};

TEST(DepthRows, ThePlatesRowsAreItsWayAlongTheAxis) {
  const HandMadeImage image = plate(kFacing);
  DepthImage depth_m = sensed(image.robot);
  for (float& z_m : depth_m.pixels()) z_m += 0.01F;
  const std::vector<FitRow> rows = rows_of(image.robot, depth_m);
  ASSERT_EQ(rows.size(), 38U * 28) << "all but the pixels at its outline";
  for (const FitRow& row : rows) {
    EXPECT_EQ(row.link, 1);
    EXPECT_NEAR(row.p_C_m.z(), 1, 1e-6);
    EXPECT_NEAR(std::abs(row.residual_m), 0.01, 1e-6);
    // The plate has to go back by a centimetre; sideways moves change nothing.
    EXPECT_NEAR(row.residual_m + row.per_move.dot(Eigen::Vector3d(0.3, -0.2, 0.01)), 0, 1e-6);
  }
}

TEST(DepthRows, TheBallsRowsVanishWhereTheModelMovesToTheReadings) {
  const Eigen::Vector3d centre_C_m(0.05, -0.02, 1.2);
  const Eigen::Vector3d move_m(0.006, -0.004, 0.005);
  const HandMadeImage model = ball(centre_C_m, 0.3);
  const HandMadeImage truth = ball(centre_C_m + move_m, 0.3);
  const std::vector<FitRow> rows = rows_of(model.robot, sensed(truth.robot));
  ASSERT_GT(rows.size(), 500U);
  double greatest_m = 0;
  for (const FitRow& row : rows) {
    greatest_m = std::max(greatest_m, std::abs(row.residual_m));
    // The reading is at another place of the ball: it is curved.
    EXPECT_NEAR(row.residual_m + row.per_move.dot(move_m), 0, 1e-3);
    EXPECT_NEAR(row.per_move.norm(), 1, 1e-6);
  }
  EXPECT_GT(greatest_m, 0.005);
}

TEST(DepthRows, SurfacesSeenAtAGrazingAngleAreLeftOut) {
  const HandMadeImage image = ball({0, 0, 1.2}, 0.3);
  for (const FitRow& row : rows_of(image.robot, sensed(image.robot))) {
    EXPECT_GE(std::abs(row.per_move.dot(row.p_C_m.normalized())), 0.25);
  }
}

TEST(DepthRows, TheDepthErrorsDerivativesAreRight) {
  const HandMadeImage model = ball({0, 0, 1.2}, 0.3);
  const DepthImage depth_m = sensed(ball({0.002, 0, 1.203}, 0.3).robot);
  const CameraEstimate at{.depth_offset_m = 0.001, .depth_scale = 1.001};
  CameraEstimate farther = at;
  farther.depth_offset_m += 1e-3;
  CameraEstimate larger = at;
  larger.depth_scale += 1e-3;
  const DepthRowLimits wide{1, 0.2};
  const std::vector<FitRow> rows = rows_of(model.robot, depth_m, at, wide);
  const std::vector<FitRow> by_offset = rows_of(model.robot, depth_m, farther, wide);
  const std::vector<FitRow> by_scale = rows_of(model.robot, depth_m, larger, wide);
  ASSERT_EQ(rows.size(), by_offset.size());
  ASSERT_EQ(rows.size(), by_scale.size());
  ASSERT_GT(rows.size(), 500U);
  for (std::size_t i = 0; i < rows.size(); ++i) {
    EXPECT_NEAR((by_offset[i].residual_m - rows[i].residual_m) / 1e-3, rows[i].per_depth_offset,
                1e-3);
    EXPECT_NEAR((by_scale[i].residual_m - rows[i].residual_m) / 1e-3, rows[i].per_depth_scale,
                1e-3);
    EXPECT_EQ(rows[i].per_dilation, 0);
  }
}

TEST(DepthRows, NoReadingAFarOneAndEnvironmentGiveNone) {
  HandMadeImage image = plate(kFacing);
  DepthImage depth_m = sensed(image.robot);
  const std::size_t all = rows_of(image.robot, depth_m).size();
  depth_m(40, 30) = kNoDepth;
  depth_m(42, 30) = 1.04F;
  depth_m(44, 30) = 0.96F;
  depth_m(46, 30) = 1.02F;
  EXPECT_EQ(rows_of(image.robot, depth_m).size(), all - 3);
  EXPECT_EQ(rows_of(image.robot, depth_m, {}, {1, 0.05}).size(), all - 1);
  add_plate(kFacing, 1, kEnvironmentLink, image);
  EXPECT_TRUE(rows_of(image.robot, depth_m).empty());
}

TEST(DepthRows, AStrideTakesFewerPixels) {
  const HandMadeImage image = plate(kFacing);
  const std::size_t all = rows_of(image.robot, sensed(image.robot)).size();
  const std::size_t some = rows_of(image.robot, sensed(image.robot), {}, {3, 0.03}).size();
  EXPECT_NEAR(static_cast<double>(some), static_cast<double>(all) / 9, 20);
}

}  // namespace
}  // namespace berth
