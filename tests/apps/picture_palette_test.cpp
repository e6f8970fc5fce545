#include "apps/berth/picture_palette.hpp"

#include <gtest/gtest.h>

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <set>

namespace berth::app {
namespace {

double linear(std::uint8_t value) {
  const double c = value / 255.0;
  return c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4);
}

/// CIE L*a*b* of what an eye with the given response to linear RGB sees.
Eigen::Vector3d lab(Rgb color, const Eigen::Matrix3d& eye) {
  const Eigen::Vector3d rgb =
      (eye * Eigen::Vector3d(linear(color.r), linear(color.g), linear(color.b)))
          .cwiseMax(0)
          .cwiseMin(1);
  const auto f = [](double t) { return t > 0.008856 ? std::cbrt(t) : 7.787 * t + 16.0 / 116; };
  const double x = f(Eigen::Vector3d(0.4124, 0.3576, 0.1805).dot(rgb) / 0.95047);
  const double y = f(Eigen::Vector3d(0.2126, 0.7152, 0.0722).dot(rgb));
  const double z = f(Eigen::Vector3d(0.0193, 0.1192, 0.9505).dot(rgb) / 1.08883);
  return {116 * y - 16, 500 * (x - y), 200 * (y - z)};
}

/// Machado, Oliveira and Fernandes (2009), severity 1.
std::vector<Eigen::Matrix3d> eyes() {
  std::vector<Eigen::Matrix3d> eyes(4);
  eyes[0].setIdentity();
  eyes[1] << 0.152286, 1.052583, -0.204868, 0.114503, 0.786281, 0.099216, -0.003882, -0.048116,
      1.051998;
  eyes[2] << 0.367322, 0.860646, -0.227968, 0.280085, 0.672501, 0.047413, -0.011820, 0.042940,
      0.968881;
  eyes[3] << 1.255528, -0.076749, -0.178779, -0.078411, 0.930809, 0.147602, 0.004733, 0.691367,
      0.303900;
  return eyes;
}

TEST(PicturePalette, TwelveLinksStayApartForEveryKindOfColourBlindness) {
  for (const Eigen::Matrix3d& eye : eyes()) {
    for (LinkId a = 1; a <= 12; ++a) {
      for (LinkId b = 1; b < a; ++b) {
        EXPECT_GT((lab(link_color(a), eye) - lab(link_color(b), eye)).norm(), 15) << a << ", " << b;
      }
    }
  }
}

TEST(PicturePalette, ThirtySixLinksHaveColoursOfTheirOwn) {
  std::set<std::tuple<int, int, int>> colors;
  for (LinkId id = 1; id <= 36; ++id) {
    const Rgb c = link_color(id);
    colors.insert({c.r, c.g, c.b});
  }
  EXPECT_EQ(colors.size(), 36U);
  EXPECT_EQ(link_color(37), link_color(1));
}

TEST(PicturePalette, NeighboursOfALongChainStayApart) {
  const Eigen::Matrix3d eye = eyes().front();
  for (LinkId id = 1; id < 82; ++id)
    EXPECT_GT((lab(link_color(id), eye) - lab(link_color(id + 1), eye)).norm(), 25) << id;
}

}  // namespace
}  // namespace berth::app
