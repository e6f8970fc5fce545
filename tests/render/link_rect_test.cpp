#include "berth/render/link_rect.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "tests/render/small_robot.hpp"

namespace berth {
namespace {

const Camera kCamera{64, 48, 60, 55, 31.4, 23.9};

bool holds(const PixelRect& rect, int u, int v) {
  return u >= rect.u_begin && u < rect.u_end && v >= rect.v_begin && v < rect.v_end;
}

Eigen::AlignedBox3f cube(float half_m) {
  return {Eigen::Vector3f::Constant(-half_m), Eigen::Vector3f::Constant(half_m)};
}

TEST(ProjectBox, HoldsThePixelsOfAllPointsInFrontOfTheCamera) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> any(-1, 1);
  std::uniform_real_distribution<double> magnitude(-4, 0.5);
  int seen = 0;
  for (int trial = 0; trial < 3000; ++trial) {
    const Eigen::Vector3f centre(any(random), any(random), any(random));
    const Eigen::Vector3f half(std::pow(10, magnitude(random)), std::pow(10, magnitude(random)),
                               std::pow(10, magnitude(random)));
    const Eigen::AlignedBox3f box_L(centre - half, centre + half);
    Pose X_CL = at(any(random), any(random), 1 + 2 * any(random));
    X_CL.linear() = Eigen::Quaterniond(any(random), any(random), any(random), any(random))
                        .normalized()
                        .toRotationMatrix();
    const PixelRect rect = project_box(box_L, X_CL, kCamera);
    ASSERT_GE(rect.u_begin, 0);
    ASSERT_GE(rect.v_begin, 0);
    ASSERT_LE(rect.u_end, kCamera.width_px);
    ASSERT_LE(rect.v_end, kCamera.height_px);
    for (int i = 0; i < 30; ++i) {
      // Rounded, many of these are the box's corners and edges.
      Eigen::Vector3d p(any(random), any(random), any(random));
      if (i % 2 == 0) p = p.array().round();
      const Eigen::Vector3d p_C =
          X_CL * (centre.cast<double>() + half.cast<double>().cwiseProduct(p));
      if (p_C.z() <= 0) continue;
      const double u = std::round(kCamera.fx_px * p_C.x() / p_C.z() + kCamera.cx_px);
      const double v = std::round(kCamera.fy_px * p_C.y() / p_C.z() + kCamera.cy_px);
      if (u < 0 || v < 0 || u >= kCamera.width_px || v >= kCamera.height_px) continue;
      ++seen;
      ASSERT_TRUE(holds(rect, static_cast<int>(u), static_cast<int>(v))) << trial;
    }
  }
  EXPECT_GT(seen, 5000);
}

TEST(ProjectBox, IsNoMoreThanTwoPixelsLargerThanABoxFacingTheCamera) {
  // At its front, 2 m away, the cube reaches from -0.25 m to 0.25 m.
  const PixelRect rect = project_box(cube(0.25F), at(0, 0, 2.25), kCamera);
  const double left_px = 31.4 - 60 * 0.125;
  const double right_px = 31.4 + 60 * 0.125;
  EXPECT_LE(rect.u_begin, std::ceil(left_px));
  EXPECT_GE(rect.u_begin, std::floor(left_px) - 2);
  EXPECT_GT(rect.u_end, std::floor(right_px));
  EXPECT_LE(rect.u_end, std::ceil(right_px) + 3);
}

TEST(ProjectBox, IsTheWholeImageWhereTheBoxReachesTheCameraPlane) {
  for (const double z_m : {0.2, 0.0, -0.2}) {
    const PixelRect rect = project_box(cube(0.25F), at(0.3, 0, z_m), kCamera);
    EXPECT_EQ(rect.u_begin, 0);
    EXPECT_EQ(rect.v_begin, 0);
    EXPECT_EQ(rect.u_end, 64);
    EXPECT_EQ(rect.v_end, 48);
  }
}

TEST(ProjectBox, IsEmptyBehindTheCameraAndOutsideTheImage) {
  EXPECT_TRUE(project_box(cube(0.25F), at(0, 0, -0.3), kCamera).empty());
  for (const auto& [x_m, y_m] : {std::pair{4.0, 0.0}, {-4.0, 0.0}, {0.0, 4.0}, {0.0, -4.0}})
    EXPECT_TRUE(project_box(cube(0.25F), at(x_m, y_m, 2), kCamera).empty());
}

TEST(ProjectBox, BoxLessThanAMillimetreAwayIsNotEmpty) {
  EXPECT_FALSE(project_box(cube(1e-4F), at(0, 0, 5e-4), kCamera).empty());
}

}  // namespace
}  // namespace berth
