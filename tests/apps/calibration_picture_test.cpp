#include "apps/berth/calibration_picture.hpp"

#include <cairo/cairo.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "apps/berth/calibration_frames.hpp"
#include "apps/berth/flying_pixels_at_robot.hpp"
#include "apps/berth/residual_colors.hpp"
#include "apps/berth/residual_histogram.hpp"
#include "tests/support/temporary_folder.hpp"

namespace berth::app {
namespace {

Image<Rgb> read_png(const std::filesystem::path& file) {
  cairo_surface_t* surface = cairo_image_surface_create_from_png(file.c_str());
  EXPECT_EQ(cairo_surface_status(surface), CAIRO_STATUS_SUCCESS);
  Image<Rgb> pixels(cairo_image_surface_get_width(surface),
                    cairo_image_surface_get_height(surface));
  const unsigned char* data = cairo_image_surface_get_data(surface);
  const int stride = cairo_image_surface_get_stride(surface);
  for (int y = 0; y < pixels.height(); ++y) {
    for (int x = 0; x < pixels.width(); ++x) {
      const unsigned char* p = data + y * stride + 4 * x;
      pixels(x, y) = {p[2], p[1], p[0]};
    }
  }
  cairo_surface_destroy(surface);
  return pixels;
}

/// A robot of 20 x 20 pixels at 1 m in the middle, before a wall.
struct OneSquare {
  static constexpr int kWidth = 60, kHeight = 50;
  CalibrationCamera camera;
  RobotImage robot{DepthImage(kWidth, kHeight, kNoDepth), Image<LinkId>(kWidth, kHeight, kNoLink)};

  explicit OneSquare(int frames = 1) {
    camera.camera = {kWidth, kHeight, 100, 100, 30, 25};
    for (int k = 0; k < frames; ++k) {
      camera.frames.push_back({k, DepthImage(kWidth, kHeight, 2.0F), {}});
    }
    for (int v = 15; v < 35; ++v) {
      for (int u = 20; u < 40; ++u) {
        robot.depth_m(u, v) = camera.frames[0].depth_m(u, v) = 1;
        robot.link_id(u, v) = 1;
      }
    }
  }
  DepthImage& depth_m() { return camera.frames[0].depth_m; }
  DepthImage residual_m() {
    DepthImage residual_m = depth_m();
    for (std::size_t i = 0; i < residual_m.pixels().size(); ++i) {
      residual_m.pixels()[i] -= robot.depth_m.pixels()[i];
    }
    return residual_m;
  }
  /// The picture's pixels in the middle of the sensor's, which it has four times as large.
  Image<Rgb> drawn(const PixelRect& part = {0, 0, kWidth, kHeight}) {
    const TemporaryFolder folder;
    const DepthImage off_m = residual_m();
    const Image<std::uint8_t> flying = flying_pixels_at_robot(camera, 0, robot);
    const Image<Rgb> large = read_png(folder.write(
        "one.png",
        calibration_picture_png({depth_m(), depth_tone(depth_m()), &robot, off_m, flying, part})));
    Image<Rgb> small(large.width() / 4, large.height() / 4);
    for (int v = 0; v < small.height(); ++v) {
      for (int u = 0; u < small.width(); ++u) small(u, v) = large(4 * u + 2, 4 * v + 2);
    }
    return small;
  }
};

bool is_grey(Rgb c) { return c.r == c.g && c.g == c.b; }

TEST(CalibrationPicture, TheRobotHasTheColoursOfItsResiduals) {
  OneSquare one;
  one.depth_m()(25, 20) = 1.02F;
  one.depth_m()(26, 20) = 0.98F;
  const DepthImage residual_m = one.residual_m();
  const Image<Rgb> drawn = one.drawn();
  EXPECT_EQ(drawn.width(), OneSquare::kWidth);
  EXPECT_EQ(drawn(30, 25), residual_color(0));
  EXPECT_EQ(drawn(25, 20), residual_color(residual_m(25, 20)));
  EXPECT_EQ(drawn(26, 20), residual_color(residual_m(26, 20)));
  EXPECT_EQ(drawn(20, 25), kOutlineColor);
  EXPECT_EQ(drawn(30, 34), kOutlineColor);
  EXPECT_TRUE(is_grey(drawn(10, 25)));
}

TEST(CalibrationPicture, BeyondTheScaleIsStripedAndNoReadingHatched) {
  OneSquare one;
  one.depth_m()(25, 20) = 2;
  one.depth_m()(26, 20) = 0.5F;
  one.depth_m()(27, 20) = one.depth_m()(20, 25) = kNoDepth;
  const Image<Rgb> drawn = one.drawn();
  const auto is_one_of = [](Rgb c, const Stripes& s) { return c == s.dark || c == s.light; };
  EXPECT_TRUE(is_one_of(drawn(25, 20), beyond_scale(1)));
  EXPECT_TRUE(is_one_of(drawn(26, 20), beyond_scale(-1)));
  EXPECT_LT(drawn(27, 20).g, 64);
  EXPECT_EQ(drawn(20, 25), kBlindOutlineColor);
  EXPECT_EQ(drawn(20, 26), kOutlineColor);
}

TEST(CalibrationPicture, ShowsThePartAskedFor) {
  OneSquare one;
  one.depth_m()(25, 20) = 1.02F;
  const Image<Rgb> whole = one.drawn(), part = one.drawn({18, 12, 42, 36});
  ASSERT_EQ(part.width(), 24);
  ASSERT_EQ(part.height(), 24);
  EXPECT_EQ(part(25 - 18, 20 - 12), whole(25, 20));
  EXPECT_EQ(robot_rect(one.robot.link_id), (PixelRect{20, 15, 40, 35}));
  EXPECT_TRUE(robot_rect(Image<LinkId>(5, 5, kEnvironmentLink)).empty());
}

TEST(FlyingPixelsAtRobot, AreBesideTheRobotAndLikeIt) {
  OneSquare one(5);
  one.depth_m()(42, 25) = 1.03F;  // beside it and like it
  one.depth_m()(43, 25) = 1.2F;   // behind it
  one.depth_m()(46, 25) = 1;      // 7 px, 7 cm away
  one.robot.link_id(41, 20) = kEnvironmentLink;
  one.depth_m()(41, 20) = 1;
  const Image<std::uint8_t> flying = flying_pixels_at_robot(one.camera, 0, one.robot);
  EXPECT_EQ(std::count(flying.pixels().begin(), flying.pixels().end(), 1), 1);
  EXPECT_EQ(flying(42, 25), 1);
  EXPECT_EQ(one.drawn()(42, 25), kFlyingPixelColor);
}

TEST(FlyingPixelsAtRobot, WhatMostOtherFramesShowIsEnvironment) {
  OneSquare one(5);
  for (int k = 0; k < 3; ++k) one.camera.frames[k].depth_m(42, 25) = 1.02F;
  EXPECT_EQ(flying_pixels_at_robot(one.camera, 0, one.robot)(42, 25), 0);
  one.camera.frames[2].depth_m(42, 25) = 2;
  EXPECT_EQ(flying_pixels_at_robot(one.camera, 0, one.robot)(42, 25), 1);
}

TEST(FramesToDraw, AreAllOrSpreadWithTheWorst) {
  CalibrationCamera camera;
  CalibrationCoverage coverage;
  for (int k = 0; k < 30; ++k) {
    camera.frames.push_back({100 + k, {}, {}});
    coverage.frames.push_back({100 + k, 1, 1, 1, k == 7 ? 0.02 : 0.01});
  }
  EXPECT_EQ(frames_to_draw(camera, coverage), (std::vector<std::size_t>{0, 7, 11, 17, 23, 29}));
  EXPECT_EQ(frames_to_draw(camera, {}), (std::vector<std::size_t>{0, 5, 11, 17, 23, 29}));
  coverage.frames[7].median_residual_m = 0;
  coverage.frames[29].median_residual_m = 1;
  EXPECT_EQ(frames_to_draw(camera, coverage), (std::vector<std::size_t>{0, 5, 11, 17, 23, 29}));
  camera.frames.resize(4);
  EXPECT_EQ(frames_to_draw(camera, coverage), (std::vector<std::size_t>{0, 1, 2, 3}));
}

/// Of the sRGB values, which the eye sees about evenly spaced.
double lightness(Rgb c) { return 0.299 * c.r + 0.587 * c.g + 0.114 * c.b; }

TEST(ResidualColors, TheScaleIsFinerAroundZeroAndCanBeReadBack) {
  EXPECT_EQ(scale_place(0), 0);
  EXPECT_NEAR(scale_place(0.01), 1.0 / 3, 1e-12);
  EXPECT_NEAR(scale_place(-0.03), -2.0 / 3, 1e-12);
  EXPECT_NEAR(scale_place(0.5), 1, 1e-12);
  for (double m = -0.1; m <= 0.1; m += 0.003) EXPECT_NEAR(residual_at(scale_place(m)), m, 1e-12);
}

TEST(ResidualColors, AreDarkerTheFartherFromZeroAndApartByHue) {
  for (const double sign : {-1, 1}) {
    for (double m = 0.001; m <= 0.1; m += 0.001) {
      EXPECT_LT(lightness(residual_color(sign * m)), lightness(residual_color(sign * (m - 0.001))));
    }
  }
  for (double m = 0.003; m <= 0.1; m += 0.001) {
    // Yellow against blue is the difference that all but the rarest colour-blind see.
    const Rgb nearer = residual_color(-m), farther = residual_color(m);
    EXPECT_GT(nearer.r, nearer.b);
    EXPECT_GT(farther.b, farther.r);
  }
  EXPECT_EQ(residual_color(0.0), residual_color(-1e-9));
}

TEST(ResidualColors, AreLinearBetweenTheScalesNeighbours) {
  const std::vector<ResidualColor> scale = residual_scale();
  EXPECT_EQ(scale.front().residual_m, -kResidualScale_m);
  EXPECT_EQ(scale.back().residual_m, kResidualScale_m);
  for (std::size_t i = 0; i + 1 < scale.size(); ++i) {
    for (const double share : {0.0, 0.3, 0.5, 0.9, 1.0}) {
      const double residual_m = std::lerp(scale[i].residual_m, scale[i + 1].residual_m, share);
      const Rgb expected = mix(scale[i].color, scale[i + 1].color, share);
      const Rgb color = residual_color(residual_m);
      EXPECT_NEAR(color.r, expected.r, 1) << residual_m;
      EXPECT_NEAR(color.g, expected.g, 1) << residual_m;
      EXPECT_NEAR(color.b, expected.b, 1) << residual_m;
    }
  }
}

TEST(ResidualHistogram, CountsWhatIsTheRobots) {
  DepthImage residual_m(10, 1, kNoDepth);
  const std::array<float, 6> values = {0, 0.0009F, -0.0031F, 0.07F, 0.11F, -0.3F};
  std::copy(values.begin(), values.end(), residual_m.row(0));
  ResidualHistogram histogram;
  histogram.add(residual_m);
  EXPECT_EQ(histogram.count(), 4);
  EXPECT_EQ(histogram.share(ResidualHistogram::kBins / 2), 0.5);
  EXPECT_EQ(histogram.share(ResidualHistogram::kBins / 2 - 2), 0.25);
  EXPECT_EQ(histogram.share(ResidualHistogram::kBins - 1), 0.25);
  EXPECT_NEAR(ResidualHistogram::residual_m(ResidualHistogram::kBins / 2 - 2), -0.004, 1e-12);
}

TEST(ResidualHistogram, NothingCountedHasNoShares) {
  const ResidualHistogram nothing;
  EXPECT_EQ(nothing.share(3), 0);
  EXPECT_EQ(histogram_svg(nothing, nothing).find("nan"), std::string::npos);
}

}  // namespace
}  // namespace berth::app
