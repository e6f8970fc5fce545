// What age leaves of free depth, beside its definition pixel by pixel, to the bit.
#include "berth/space/aged_depth.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "berth/space/camera_space.hpp"
#include "sim/plain_aging.hpp"
#include "sim/random.hpp"
#include "tests/support/only_target.hpp"
#include "tests/support/thinned.hpp"

namespace berth::testing {
namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();
constexpr float kCount_m = 1 / 2048.0F;

/// Its pixels' readings, and what each frees; both counted in 1/2048 m.
struct AgedCase {
  Camera camera;
  DepthImage sensed_m;
  DepthImage own_m;
  double moved_m = 0;
  /// Of no size where there is no environment.
  DepthImage environment_front_m = {};
};

/// How many pixels beside it this reading holds.
double reach_of(const AgedCase& asked, int u, int v) {
  const double sensed_m = asked.sensed_m(u, v);
  if (std::isnan(sensed_m) || asked.moved_m == 0) return 0;
  const double spread_px_m = std::max(asked.camera.fx_px, asked.camera.fy_px) * asked.moved_m;
  return sensed_m > 0 ? std::ceil(spread_px_m / sensed_m) : 1e6;
}

float counted(double depth_m) {
  return static_cast<float>(std::floor(depth_m / kCount_m) * kCount_m);
}

/// Readings from `near_m` to `far_m`, in patches, with holes and single pixels among them.
AgedCase draw_case(sim::Random& random, int width, int height, double near_m, double far_m) {
  AgedCase out;
  out.camera = {width, height, random(20, 700), random(20, 700), 0.5 * width, 0.5 * height};
  out.sensed_m = out.own_m = DepthImage(width, height, 0);
  const int patch = random.whole(1, 9);
  for (int v = 0; v < height; ++v) {
    for (int u = 0; u < width; ++u) {
      const bool is_first = u % patch == 0 && v % patch == 0;
      float& sensed_m = out.sensed_m(u, v);
      sensed_m = is_first || random.chance(0.02) ? counted(random(near_m, far_m))
                                                 : out.sensed_m(u - u % patch, v - v % patch);
      if (random.chance(0.05)) sensed_m = kNoDepth;
      const double before_m = std::isnan(sensed_m) ? 1 : sensed_m;
      out.own_m(u, v) = counted(before_m * random(0.9, 1.1));
      if (random.chance(0.05)) out.own_m(u, v) = 0;
      if (random.chance(0.05)) out.own_m(u, v) = kInfinity;
    }
  }
  return out;
}

/// A solid in some patches, before, at and behind what their pixels free.
void draw_environment(sim::Random& random, AgedCase& out) {
  out.environment_front_m = DepthImage(out.own_m.width(), out.own_m.height(), kNoDepth);
  const int patch = random.whole(4, 12);
  for (int v = 0; v < out.own_m.height(); ++v) {
    for (int u = 0; u < out.own_m.width(); ++u) {
      if ((u / patch + v / patch) % 3 == 0) continue;
      const float own_m = std::isinf(out.own_m(u, v)) ? 2 : out.own_m(u, v);
      out.environment_front_m(u, v) = static_cast<float>(own_m * random(0.8, 1.02));
    }
  }
}

UnitImage units_of(const DepthImage& depth_m) {
  UnitImage out(depth_m.width(), depth_m.height());
  for (std::size_t i = 0; i < out.pixels().size(); ++i) {
    const float m = depth_m.pixels()[i];
    out.pixels()[i] = std::isfinite(m) ? static_cast<std::uint16_t>(m / kCount_m) : 65535;
  }
  return out;
}

void age(const AgedCase& asked, AgingWorkspace& workspace, DepthWindows& out) {
  DepthCeiling solid;
  UnitImage scratch;
  const bool has_solid = asked.environment_front_m.width() > 0;
  if (has_solid) build_environment_ceiling(asked.environment_front_m, scratch, solid);
  age_free_depth(asked.camera, units_of(asked.sensed_m), units_of(asked.own_m),
                 has_solid ? &solid.left : nullptr, asked.moved_m, workspace, out);
}

void expect_as_defined(const AgedCase& asked, AgingWorkspace& workspace) {
  const DepthImage expected_m =
      sim::plainly_aged(asked.camera, asked.sensed_m, asked.own_m, asked.environment_front_m,
                        asked.moved_m);
  DepthWindows found;
  age(asked, workspace, found);
  ASSERT_EQ(found.width(), expected_m.width());
  ASSERT_EQ(found.height(), expected_m.height());
  for (int v = 0; v < expected_m.height(); ++v) {
    for (int u = 0; u < expected_m.width(); ++u) {
      ASSERT_EQ(in_metres(found(u, v)), expected_m(u, v)) << "pixel " << u << " " << v;
    }
  }
}

/// The minimum over all pixels within its reach, and no blocks.
TEST(AgedDepth, HoldsForAtLeastThePixelsWithinReach) {
  sim::Random random(3);
  AgingWorkspace workspace;
  for (int i = 0; i < thinned(60); ++i) {
    AgedCase asked = draw_case(random, random.whole(3, 120), random.whole(3, 60), 0.05, 0.6);
    asked.moved_m = random(0, 0.1);
    DepthWindows found;
    age(asked, workspace, found);
    for (int v = 0; v < found.height(); ++v) {
      for (int u = 0; u < found.width(); ++u) {
        const double left_m = std::max(0.0, asked.own_m(u, v) - asked.moved_m);
        const int reach = static_cast<int>(reach_of(asked, u, v)) + 1;
        for (int y = std::max(0, v - reach); y <= std::min(found.height() - 1, v + reach); ++y) {
          for (int x = std::max(0, u - reach); x <= std::min(found.width() - 1, u + reach); ++x) {
            ASSERT_LE(in_metres(found(x, y)), left_m) << i << ": " << u << " " << v;
          }
        }
      }
    }
  }
}

TEST(AgedDepth, IsThatOfTheDefinitionAtAllSizesAndReaches) {
  sim::Random random(1);
  AgingWorkspace workspace;
  std::vector<int> with_reach(60);
  for (int i = 0; i < thinned(300); ++i) {
    const int width = i % 3 == 0 ? random.whole(1, 20) : random.whole(1, 90);
    const int height = i % 3 == 1 ? random.whole(1, 4) : random.whole(1, 60);
    const double near_m = i % 4 == 0 ? 0.002 : random(0.1, 0.5);
    AgedCase asked = draw_case(random, width, height, near_m, near_m + random(0, 2));
    asked.moved_m = i % 10 == 0 ? 0 : random(0, 0.1);
    if (i % 2 == 0) draw_environment(random, asked);
    SCOPED_TRACE("case " + std::to_string(i) + ", " + std::to_string(width) + " x " +
                 std::to_string(height));
    expect_as_defined(asked, workspace);
    if (HasFatalFailure()) return;
    for (int v = 0; v < height; ++v) {
      for (int u = 0; u < width; ++u) ++with_reach[std::min(reach_of(asked, u, v), 59.0)];
    }
  }
  // Nothing of that is left out by chance.
  EXPECT_EQ(std::ranges::count(with_reach, 0), 0);
}

TEST(AgedDepth, EachReachAloneReachesJustSoFar) {
  constexpr int kSide = 151;
  AgingWorkspace workspace;
  for (int reach = 1; reach < 70; ++reach) {
    SCOPED_TRACE(reach);
    AgedCase asked{{kSide, kSide, 500, 400, 75, 75},
                   DepthImage(kSide, kSide, kNoDepth),
                   DepthImage(kSide, kSide, 5),
                   0.02};
    // 500 px x 0.02 m / S is this reach, some of them exactly; an odd one lies just beyond the
    // number below.
    asked.sensed_m(75, 75) = counted(10.0 / reach);
    if (reach % 2 == 1) asked.sensed_m(75, 75) = counted(10.0 / (reach - 0.999));
    asked.own_m(75, 75) = 1;
    expect_as_defined(asked, workspace);
    if (HasFatalFailure()) return;
  }
}

TEST(AgedDepth, ASurfaceRightBeforeTheCameraHoldsForTheWholeImage) {
  AgingWorkspace workspace;
  AgedCase asked{{64, 48, 60, 60, 32, 24}, DepthImage(64, 48, 2), DepthImage(64, 48, 1.875F), 0.05};
  asked.sensed_m(3, 40) = 20 * kCount_m;
  asked.own_m(3, 40) = 0;
  expect_as_defined(asked, workspace);
  DepthWindows found;
  age(asked, workspace, found);
  for (int v = 0; v < 48; ++v) {
    for (int u = 0; u < 64; ++u) ASSERT_EQ(found(u, v), 0);
  }
}

/// A table whose edge lies at column 32; the floor is 1 m below. What hides under it comes out at
/// the edge, and nowhere else.
TEST(AgedDepth, NothingComesOutOfASolidButAtItsEdge) {
  AgingWorkspace workspace;
  constexpr int kWidth = 64, kHeight = 48, kEdge = 32;
  AgedCase asked{{kWidth, kHeight, 100, 100, 32, 24},
                 DepthImage(kWidth, kHeight, 2),
                 DepthImage(kWidth, kHeight, 1.875F),
                 0.0625,
                 DepthImage(kWidth, kHeight, kNoDepth)};
  for (int v = 0; v < kHeight; ++v) {
    for (int u = 0; u < kEdge; ++u) {
      asked.sensed_m(u, v) = asked.environment_front_m(u, v) = 1;
      asked.own_m(u, v) = 1.03125F;
    }
  }
  expect_as_defined(asked, workspace);
  DepthWindows found;
  age(asked, workspace, found);
  // ceil(100 px x 0.0625 m / 1 m), and one for the least of 3 x 3. The image's border is an edge.
  constexpr int kReach = 7 + 1;
  for (int v = kReach + 1; v < kHeight - kReach - 1; ++v) {
    for (int u = kReach + 1; u < kWidth - 1; ++u) {
      // The edge's last column, whose neighbours show no table, still holds for others.
      const bool is_near_edge = std::abs(u - (kEdge - 1)) <= kReach;
      const float far_m = u < kEdge ? 1 : 1.8125F;
      EXPECT_EQ(in_metres(found(u, v)), is_near_edge ? 0.96875F : far_m) << u << " " << v;
    }
  }
}

TEST(AgedDepth, OnEveryInstructionSetAndWithMemoryOfAnyImageBefore) {
  on_every_target([](const char* target) {
    SCOPED_TRACE(target);
    sim::Random random(2);
    AgingWorkspace workspace;
    for (int i = 0; i < thinned(40); ++i) {
      const int width = random.whole(1, 100);
      const int height = random.whole(1, 40);
      AgedCase asked = draw_case(random, width, height, random.chance(0.3) ? 0.003 : 0.2, 2);
      asked.moved_m = random(0, 0.1);
      if (i % 2 == 0) draw_environment(random, asked);
      SCOPED_TRACE(i);
      expect_as_defined(asked, workspace);
    }
  });
}

}  // namespace
}  // namespace berth::testing
