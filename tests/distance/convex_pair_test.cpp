#include "berth/distance/convex_pair.hpp"

#include <gtest/gtest.h>

#include <array>
#include <vector>

#include "sim/random.hpp"

namespace berth::testing {
namespace {

using mesh::closest_points;
using mesh::ConvexPair;
using Points = std::vector<Eigen::Vector3d>;

Points draw_points(sim::Random& random, int count, const Eigen::Vector3d& about_m) {
  Points points;
  for (int i = 0; i < count; ++i) {
    points.push_back(about_m + Eigen::Vector3d(random(-1, 1), random(-1, 1), random(-1, 1)) * 0.5);
  }
  return points;
}

/// No point of one body is on the other's side of the plane through its nearest point: that is what
/// makes a pair of two convex bodies the closest one.
void expect_closest(const Points& a, const Points& b, const ConvexPair& pair) {
  const Eigen::Vector3d n = pair.a_m - pair.b_m;
  EXPECT_NEAR(n.norm(), pair.distance_m, 1e-12);
  for (const auto& p : a) EXPECT_GE(n.dot(p - pair.a_m), -1e-9);
  for (const auto& p : b) EXPECT_LE(n.dot(p - pair.b_m), 1e-9);
}

TEST(ConvexPair, APlaneLiesBetween) {
  sim::Random random(1);
  for (int i = 0; i < 2000; ++i) {
    const Points a = draw_points(random, random.whole(1, 3), {random(-1, 1), random(-1, 1), 0});
    const Points b = draw_points(random, random.whole(1, 8), {0, 0, random(0, 2)});
    expect_closest(a, b, closest_points(a, b));
  }
}

TEST(ConvexPair, BodiesThatMeetShareAPoint) {
  const Points box = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0},
                      {0, 0, 1}, {1, 0, 1}, {0, 1, 1}, {1, 1, 1}};
  const Points through = {{-1, 0.4, 0.5}, {2, 0.5, 0.4}, {0.5, 3, 0.5}};
  const ConvexPair pair = closest_points(through, box);
  EXPECT_EQ(pair.distance_m, 0);
  EXPECT_EQ(pair.a_m, pair.b_m);
  for (int i = 0; i < 3; ++i) {
    EXPECT_GE(pair.a_m[i], -1e-9);
    EXPECT_LE(pair.a_m[i], 1 + 1e-9);
  }
}

/// A pixel's chunk is long and thin, and triangles may be needles or points.
TEST(ConvexPair, ThinBodies) {
  sim::Random random(2);
  for (int i = 0; i < 2000; ++i) {
    Points chunk;
    const double width = 1e-3 * random(0.5, 2);
    const double end = random(1.01, 30);
    for (int k = 0; k < 8; ++k) {
      const double z = k & 4 ? end : 1;
      chunk.push_back({z * width * (k & 1), z * width * (k >> 1 & 1), z});
    }
    Points needle = draw_points(random, 2, {random(-1, 1), random(-1, 1), random(0, 3)});
    needle.push_back(needle[0] + 1e-7 * (needle[1] - needle[0]));
    expect_closest(needle, chunk, closest_points(needle, chunk));
  }
}

}  // namespace
}  // namespace berth::testing
