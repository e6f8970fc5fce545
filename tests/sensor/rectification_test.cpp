#include "berth/sensor/rectification.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace berth {
namespace {

const Camera kGiven{320, 240, 180, 175, 163.5, 112.5};
// Of an Azure Kinect, a webcam, and a fisheye.
const Lens kRational{.coefficients = {0.78, -2.98, 0.0007, 0.00005, 1.69, 0.65, -2.81, 1.63}};
const Lens kBarrel{.coefficients = {-0.2, 0.04, 0.001, -0.002, 0}};
const Lens kFisheye{.is_fisheye = true, .coefficients = {-0.02, 0.005, -0.003, 0.0005}};

/// By the formulas as OpenCV's documentation writes them; nothing of it is shared with the code.
Eigen::Vector2d bent_pixel(const Lens& lens, const Camera& camera, double x, double y) {
  const auto& k = lens.coefficients;
  const double r = std::hypot(x, y), r2 = r * r, r4 = r2 * r2, r6 = r4 * r2;
  double xd = 0, yd = 0;
  if (lens.is_fisheye) {
    const double t = std::atan(r), td = t + k[0] * std::pow(t, 3) + k[1] * std::pow(t, 5) +
                                        k[2] * std::pow(t, 7) + k[3] * std::pow(t, 9);
    xd = r > 0 ? td / r * x : 0;
    yd = r > 0 ? td / r * y : 0;
  } else {
    const double radial =
        (1 + k[0] * r2 + k[1] * r4 + k[4] * r6) / (1 + k[5] * r2 + k[6] * r4 + k[7] * r6);
    xd = x * radial + 2 * k[2] * x * y + k[3] * (r2 + 2 * x * x);
    yd = y * radial + k[2] * (r2 + 2 * y * y) + 2 * k[3] * x * y;
  }
  return {camera.fx_px * xd + camera.cx_px, camera.fy_px * yd + camera.cy_px};
}

/// The pixel (u, v) of the rectified image, in the one that came.
Eigen::Vector2d came_from(const Rectification& made, const Lens& lens, int u, int v) {
  const Camera& camera = made.camera();
  return bent_pixel(lens, made.given(), (u - camera.cx_px) / camera.fx_px,
                    (v - camera.cy_px) / camera.fy_px);
}

class ALens : public testing::TestWithParam<Lens> {};
INSTANTIATE_TEST_SUITE_P(Of, ALens, testing::Values(kRational, kBarrel, kFisheye));

TEST_P(ALens, GivesEachPixelTheReadingThatLiesThere) {
  const Rectification made(kGiven, GetParam(), DepthIs::along_axis);
  DepthImage given_m(320, 240);
  for (int v = 0; v < 240; ++v) {
    for (int u = 0; u < 320; ++u) given_m(u, v) = 1 + 0.001F * u + 0.01F * v;
  }
  const DepthImage made_m = made.apply(given_m);
  int told = 0;
  for (int v = 0; v < made_m.height(); ++v) {
    for (int u = 0; u < made_m.width(); ++u) {
      if (std::isnan(made_m(u, v))) continue;
      const Eigen::Vector2d at = came_from(made, GetParam(), u, v);
      // A pixel's half, and where a second one fell into it one more.
      EXPECT_NEAR(made_m(u, v), 1 + 0.001 * at.x() + 0.01 * at.y(), 0.018) << u << ", " << v;
      ++told;
    }
  }
  EXPECT_GT(told, 0.9 * 320 * 240);
}

TEST_P(ALens, LosesNoThinRodAnywhereInTheImage) {
  const Rectification made(kGiven, GetParam(), DepthIs::along_axis);
  for (int step = 0; step < 40; ++step) {
    DepthImage rod_m(320, 240, 3);
    std::vector<Pixel> pixels;
    for (int i = 0; i < 240; ++i) pixels.push_back({(8 * step + i * step / 40) % 320, i});
    for (int i = 0; i < 320; ++i) pixels.push_back({i, 6 * step});
    for (const Pixel& p : pixels) rod_m(p.u, p.v) = 1;
    const DepthImage made_m = made.apply(rod_m);
    std::vector<bool> is_told(320 * 240);
    for (int v = 0; v < made_m.height(); ++v) {
      for (int u = 0; u < made_m.width(); ++u) {
        if (made_m(u, v) != 1) continue;
        const Eigen::Vector2d at = came_from(made, GetParam(), u, v);
        for (int dv = -1; dv <= 1; ++dv) {
          for (int du = -1; du <= 1; ++du) {
            const long x = std::lround(at.x()) + du, y = std::lround(at.y()) + dv;
            if (x >= 0 && y >= 0 && x < 320 && y < 240) is_told[y * 320 + x] = true;
          }
        }
      }
    }
    for (const Pixel& p : pixels) EXPECT_TRUE(is_told[p.v * 320 + p.u]) << p.u << ", " << p.v;
  }
}

TEST_P(ALens, SeesAllThatTheImageShows) {
  const Rectification made(kGiven, GetParam(), DepthIs::along_axis);
  std::vector<bool> is_met(320 * 240);
  for (int pixel = 0; pixel < 320 * 240; pixel += 37) {
    DepthImage one_m(320, 240, kNoDepth);
    one_m.pixels()[pixel] = 2;
    const DepthImage made_m = made.apply(one_m);
    EXPECT_TRUE(std::ranges::any_of(made_m.pixels(), [](float z_m) { return z_m == 2; }))
        << pixel % 320 << ", " << pixel / 320;
  }
}

TEST(Rectification, KeepsTheCornersOfALensWhosePolynomialTurnsBack) {
  const Rectification made(kGiven, Lens{.coefficients = {-0.28, 0.08, 0, 0, -0.01}},
                           DepthIs::along_axis);
  for (const int pixel : {0, 319, 239 * 320, 240 * 320 - 1}) {
    DepthImage one_m(320, 240, kNoDepth);
    one_m.pixels()[pixel] = 2;
    const DepthImage made_m = made.apply(one_m);
    EXPECT_TRUE(std::ranges::any_of(made_m.pixels(), [](float z_m) { return z_m == 2; }));
  }
}

TEST(Rectification, KeepsAnImageThatNoLensBends) {
  const Rectification made(kGiven, {}, DepthIs::along_axis);
  DepthImage given_m(320, 240, 2);
  given_m(7, 9) = kNoDepth;
  const DepthImage made_m = made.apply(given_m);
  EXPECT_EQ(made.camera().fx_px, kGiven.fx_px);
  EXPECT_TRUE(std::isnan(made_m(7, 9)));
  EXPECT_EQ(made_m(8, 9), 2);
}

TEST(Rectification, TurnsDistancesIntoDepths) {
  const Rectification made(kGiven, {}, DepthIs::along_ray);
  DepthImage given_m(320, 240);
  for (int v = 0; v < 240; ++v) {
    for (int u = 0; u < 320; ++u) given_m(u, v) = point_at(kGiven, u, v, 1.5).norm();
  }
  const DepthImage made_m = made.apply(given_m);
  for (const float z_m : made_m.pixels()) EXPECT_NEAR(z_m, 1.5, 1e-6);
}

TEST(Rectification, AWideFisheyeHasAtMostFourTimesThePixels) {
  // 190 degrees from side to side.
  const Camera wide{320, 240, 96, 96, 159.5, 119.5};
  const Rectification made(wide, Lens{.is_fisheye = true}, DepthIs::along_axis);
  EXPECT_LT(made.camera().width_px * made.camera().height_px, 4.1 * 320 * 240);
  EXPECT_LT(made.camera().fx_px, 96);
  // At 60 degrees to the side.
  DepthImage given_m(320, 240, 3);
  const int u = static_cast<int>(std::lround(159.5 + 96 * std::numbers::pi / 3));
  for (int v = 0; v < 240; ++v) given_m(u, v) = 1;
  const DepthImage made_m = made.apply(given_m);
  const auto at = pixel_of(made.camera(), Eigen::Vector3d(std::tan(std::numbers::pi / 3), 0, 1));
  ASSERT_TRUE(at);
  float nearest_m = 9;
  for (int du = -3; du <= 3; ++du) nearest_m = std::fmin(nearest_m, made_m(at->u + du, at->v));
  EXPECT_EQ(nearest_m, 1);
}

}  // namespace
}  // namespace berth
