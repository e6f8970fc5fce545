#include "thesis/lattice/link_lattice.hpp"

#include <gtest/gtest.h>

#include <algorithm>

namespace berth {
namespace {

constexpr int kWidth = 150;
constexpr int kHeight = 60;

bool is_within(const PixelDisc& disc, Pixel p) {
  const int du = p.u - disc.centre.u;
  const int dv = p.v - disc.centre.v;
  return du * du + dv * dv <= disc.radius_px * disc.radius_px;
}

/// A ragged piece of a link, over word borders and the image's corners.
std::vector<Pixel> link_pixels() {
  std::vector<Pixel> pixels;
  for (int v = 0; v < kHeight; ++v) {
    for (int u = 0; u < kWidth; ++u) {
      const bool is_gap = (u * 7 + v * 13) % 11 == 0;
      if (u + v > 30 && u - v < 110 && !is_gap) pixels.push_back({u, v});
    }
  }
  pixels.push_back({0, 0});
  return pixels;
}

PixelSet set_of(const std::vector<Pixel>& pixels) {
  PixelSet set;
  set.reset(kWidth, kHeight);
  for (const Pixel p : pixels) set.insert(p);
  return set;
}

/// By rows; empties the set.
std::vector<Pixel> take_all(PixelSet& set) {
  std::vector<Pixel> pixels;
  for (Pixel p = set.first_from(0); p.u >= 0; p = set.first_from(p.v)) {
    pixels.push_back(p);
    set.erase(p);
  }
  return pixels;
}

std::vector<PixelDisc> discs() {
  std::vector<PixelDisc> all;
  for (const int radius_px : {0, 1, 2, 7, 31, 64, 200, 65536}) {
    for (const Pixel centre :
         {Pixel{0, 0}, {kWidth - 1, kHeight - 1}, {63, 20}, {64, 20}, {90, 41}}) {
      all.push_back({centre, radius_px});
    }
  }
  return all;
}

/// radius_px * radius_px of the largest is not an int.
bool holds(const PixelDisc& disc, Pixel p) { return disc.radius_px > 1000 || is_within(disc, p); }

TEST(PixelSet, HasWhatWasInserted) {
  std::vector<Pixel> expected = link_pixels();
  std::sort(expected.begin(), expected.end(),
            [](Pixel a, Pixel b) { return std::pair(a.v, a.u) < std::pair(b.v, b.u); });
  PixelSet set = set_of(expected);
  EXPECT_EQ(take_all(set), expected);
  EXPECT_EQ(set.first_from(0), Pixel{});
}

TEST(PixelSet, LosesADiscAndNothingElse) {
  for (const PixelDisc& disc : discs()) {
    PixelSet set = set_of(link_pixels());
    std::vector<Pixel> expected = take_all(set);
    std::erase_if(expected, [&](Pixel p) { return holds(disc, p); });
    set = set_of(link_pixels());
    set.erase(disc);
    EXPECT_EQ(take_all(set), expected);
  }
}

TEST(PixelSet, GetsTheDiscOfAnotherAndNothingElse) {
  for (const PixelDisc& disc : discs()) {
    PixelSet link = set_of(link_pixels());
    PixelSet found = set_of({});
    found.insert_within(disc, link);
    std::vector<Pixel> expected = take_all(link);
    std::erase_if(expected, [&](Pixel p) { return !holds(disc, p); });
    EXPECT_EQ(take_all(found), expected);
  }
}

TEST(LinkLattice, CoversTheLinkWithPointsThatLieInNoOthersCircle) {
  const std::vector<Pixel> pixels = link_pixels();
  for (const int radius_px : {1, 2, 5, 20, 60}) {
    PixelSet candidates = set_of(pixels);
    std::vector<Pixel> lattice;
    take_lattice(radius_px, 0, candidates, lattice);
    for (const Pixel p : pixels) {
      EXPECT_TRUE(std::any_of(lattice.begin(), lattice.end(), [&](Pixel q) {
        return is_within({q, radius_px}, p);
      }));
    }
    for (const Pixel p : lattice) {
      EXPECT_NE(std::find(pixels.begin(), pixels.end(), p), pixels.end());
      EXPECT_EQ(std::count_if(lattice.begin(), lattice.end(),
                              [&](Pixel q) {
                                return is_within({q, radius_px}, p);
                              }),
                1);
    }
    EXPECT_EQ(candidates.first_from(0), Pixel{});
  }
}

TEST(LinkLattice, CirclesOfRadiusZeroBlockNothing) {
  PixelSet all = set_of(link_pixels());
  PixelSet candidates = set_of(link_pixels());
  std::vector<Pixel> lattice;
  take_lattice(0, 0, candidates, lattice);
  EXPECT_EQ(lattice, take_all(all));
}

}  // namespace
}  // namespace berth
