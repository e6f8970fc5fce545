#include "berth/types/camera.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace berth {
namespace {

constexpr Camera kCamera{
    .width_px = 64, .height_px = 48, .fx_px = 60, .fy_px = 50, .cx_px = 30.5, .cy_px = 20};

/// Before the camera, where the image has this point.
Eigen::Vector3d point_at(double u, double v, double depth_m) {
  return {(u - kCamera.cx_px) / kCamera.fx_px * depth_m,
          (v - kCamera.cy_px) / kCamera.fy_px * depth_m, depth_m};
}

TEST(Camera, APixelIsHalfAPixelAroundItsCentre) {
  for (const double aside_px : {-0.499, 0.0, 0.499}) {
    EXPECT_EQ(pixel_of(kCamera, point_at(12 + aside_px, 7 - aside_px, 1.7)), (Pixel{12, 7}));
  }
  EXPECT_EQ(pixel_of(kCamera, point_at(12.501, 7, 1.7)), (Pixel{13, 7}));
}

TEST(Camera, TheImageEndsHalfAPixelBesideItsOutermostCentres) {
  EXPECT_EQ(pixel_of(kCamera, point_at(-0.499, 47.499, 0.5)), (Pixel{0, 47}));
  EXPECT_EQ(pixel_of(kCamera, point_at(63.499, -0.499, 0.5)), (Pixel{63, 0}));
  for (const auto& [u, v] : {std::pair(-0.501, 5.0), {63.501, 5.0}, {5.0, -0.501}, {5.0, 47.501}}) {
    EXPECT_FALSE(pixel_of(kCamera, point_at(u, v, 0.5))) << u << ", " << v;
  }
}

TEST(Camera, NothingBehindItOrUnknownProjectsIntoTheImage) {
  EXPECT_FALSE(project_into_image(kCamera, {0, 0, 0}));
  EXPECT_FALSE(project_into_image(kCamera, -point_at(12, 7, 1)));
  EXPECT_FALSE(project_into_image(kCamera, {0, std::nan(""), 1}));
  EXPECT_FALSE(project_into_image(kCamera, {0, 0, std::nan("")}));
}

TEST(Camera, APointBesideTheImageIsProjectedAllTheSame) {
  const ImagePoint at = project(kCamera, point_at(-12.25, 70.5, 2));
  EXPECT_NEAR(at.u, -12.25, 1e-12);
  EXPECT_NEAR(at.v, 70.5, 1e-12);
}

}  // namespace
}  // namespace berth
