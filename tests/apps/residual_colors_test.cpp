#include "apps/berth/residual_colors.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include <cmath>

#include "apps/berth/residual_histogram.hpp"

namespace berth::app {
namespace {

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
