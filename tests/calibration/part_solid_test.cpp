// The body behind what was seen of a surface.
#include "berth/calibration/part_solid.hpp"

#include <gtest/gtest.h>

#include <numbers>

#include "tests/calibration/evidence_images.hpp"

namespace berth {
namespace {

constexpr double kBehind_m = 0.012;

/// The cells of plate_view()'s plate.
CarriedCells plate_cells() {
  CarriedCells piece;
  for (double y = -0.095; y < 0.1; y += kCell_m) {
    for (double x = -0.095; x < 0.1; x += kCell_m) piece.cells.insert(cell_of({x, y, kPlate_m}));
  }
  return piece;
}

bool is_solid(const SolidCells& solid, const Eigen::Vector3d& p_m) {
  return solid.contains(cell_of(p_m));
}

TEST(PartSolid, ReachesBehindWhatNobodyLooksBehindAndNowhereElse) {
  const std::vector<EvidenceView> views(1, plate_view());
  const SolidCells solid = solid_of(plate_cells(), views, {}, kBehind_m);
  EXPECT_TRUE(is_solid(solid, {0, 0, kPlate_m}));
  EXPECT_TRUE(is_solid(solid, {0, 0, kPlate_m + 0.011}));
  EXPECT_FALSE(is_solid(solid, {0, 0, kPlate_m + 0.016}));
  EXPECT_FALSE(is_solid(solid, {0, 0, kPlate_m - 0.004}));
  EXPECT_FALSE(is_solid(solid, {0.11, 0, kPlate_m}));
}

TEST(PartSolid, AnotherCameraThatLooksBehindItSeesHowThinItIs) {
  EvidenceView behind = plate_view();
  // It looks at the plate's back, with a wall where the first camera is.
  behind.X_BC.linear() = Eigen::AngleAxisd(std::numbers::pi, Eigen::Vector3d::UnitX()).matrix();
  behind.X_BC.translation().z() = 2 * kPlate_m;
  behind.X_CB = behind.X_BC.inverse();
  const std::vector<EvidenceView> views = {plate_view(), behind};
  const SolidCells solid = solid_of(plate_cells(), views, {}, kBehind_m);
  EXPECT_TRUE(is_solid(solid, {0, 0, kPlate_m}));
  EXPECT_FALSE(is_solid(solid, {0, 0, kPlate_m + 0.011}));
}

TEST(PartSolid, ReadingsOfWhatMovesCloseToItBelongToIt) {
  const std::vector<EvidenceView> views(1, plate_view());
  const auto reading = [](double x_m) {
    MovingReading one;
    one.p_B_m = {x_m, 0, kPlate_m + 0.001};
    return one;
  };
  MovingReading explained = reading(0.097);
  explained.is_explained = true;
  MovingReading at_edge = reading(-0.103);
  at_edge.is_at_edge = true;
  CarriedCells half;
  const CarriedCells whole = plate_cells();
  for (const Cell& cell : whole.cells.cells()) {
    if (std::abs(middle_of(cell).x()) < 0.08) half.cells.insert(cell);
  }
  const auto reaches = [&](const MovingReading& more, double x_m) {
    const std::vector<MovingReading> readings(1, more);
    return is_solid(solid_of(half, views, readings, 0), {x_m, 0, kPlate_m + 0.001});
  };
  EXPECT_TRUE(reaches(reading(0.097), 0.097));
  EXPECT_FALSE(reaches(explained, 0.097)) << "by another part";
  EXPECT_FALSE(reaches(at_edge, -0.103)) << "its depth may be of neither";
  EXPECT_FALSE(reaches(reading(0.25), 0.25)) << "too far away";
}

}  // namespace
}  // namespace berth
