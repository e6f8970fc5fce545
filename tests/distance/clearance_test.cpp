// Whether a link has room: held against the whole search of mesh_distances().
#include "berth/distance/clearance.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "tests/support/mesh_world.hpp"
#include "tests/support/thinned.hpp"

namespace berth::testing {
namespace {

MeshWorld clearance_world(std::uint32_t seed) {
  MeshWorldSettings settings;
  settings.views = 1 + static_cast<int>(seed % 3);
  settings.width_px = 64;
  settings.height_px = 48;
  return draw_mesh_world(settings, 4100 + seed);
}

/// How often each answer came.
struct Counts {
  int clear = 0;
  int nearer = 0;
  int given_up = 0;
  /// Those where what is needed lies more than a centimetre below the distance.
  int easy = 0;
  int easy_clear = 0;
};

void hold(const Clearance& found, const SpacePair& truth, double needed_m, Counts& counts) {
  // A certificate, and a pair that there is.
  const double distance_m = truth.is_known() ? truth.distance_m : 10;
  if (found.is_clear) {
    EXPECT_LE(needed_m, distance_m + 1e-5);
  }
  if (found.nearest_m < needed_m) {
    EXPECT_FALSE(found.is_clear);
    EXPECT_GE(found.nearest_m, truth.lower_bound_m - 1e-5);
  }
  counts.clear += found.is_clear;
  counts.nearer += found.nearest_m < needed_m;
  counts.given_up += !found.is_clear && !(found.nearest_m < needed_m);
  if (truth.lower_bound_m < needed_m + 0.01) return;
  ++counts.easy;
  counts.easy_clear += found.is_clear;
}

TEST(Clearances, AreWhatTheWholeSearchSays) {
  constexpr MeshRequest kWhole{.range_m = 2, .tolerance_m = 1e-3};
  ClearanceWorkspace workspace;
  Counts counts;
  for (std::uint32_t seed = 0; seed < thinned(40u); ++seed) {
    const MeshWorld world = clearance_world(seed);
    const PreparedWorld prepared(world);
    const std::vector<WholeLinkDistance> truth = prepared.ask(kWhole);
    for (std::size_t i = 0; i < truth.size(); ++i) {
      const LinkPatches& link = prepared.patches().links[i];
      const Pose& X_BL = world.pose.X_BL[link.link];
      for (const double needed_m : {0.02, 0.1, 0.25, 0.5, 0.9, 1.4}) {
        for (const bool unknown : {true, false}) {
          SCOPED_TRACE(::testing::Message() << seed << ' ' << i << ' ' << needed_m << unknown);
          hold(find_clearance(link, X_BL, prepared.space(), {needed_m, unknown}, workspace),
               unknown ? truth[i].nearest : truth[i].occupied, needed_m, counts);
        }
      }
    }
  }
  EXPECT_GT(counts.clear, counts.easy / 2);
  EXPECT_GT(counts.nearer, 100);
  // A search that takes too long is given up.
  EXPECT_GE(counts.easy_clear, 0.9 * counts.easy) << counts.easy;
  RecordProperty("given_up", counts.given_up);
}

}  // namespace
}  // namespace berth::testing
