// How near each link is to what was dropped for its size and place.
#include "berth/image_distance/rejected_distances.hpp"

#include <gtest/gtest.h>

#include "berth/image_distance/brute_force.hpp"
#include "tests/support/image_settings.hpp"
#include "tests/visibility/dropped_scene.hpp"

namespace berth::testing {
namespace {

LinkDistances distances_to(const DroppedScene& scene, const DepthImage& depth_m, double range_m) {
  LinkDistances distances;
  brute_force({scene.images.camera, scene.images.robot, kDroppedLinks, SearchableDepth(depth_m),
               image_settings(range_m)},
              distances);
  return distances;
}

TEST(RejectedDistances,
     TheNearerOfBothDistancesIsThatOfTheImageFromWhichNothingRejectedWasDropped) {
  int rejected_readings = 0, none = 0;
  RejectedImage rejected;
  SearchableDepth searchable;
  RejectedWorkspace workspace;
  for (std::uint32_t seed = 0; seed < 40; ++seed) {
    const DroppedScene scene = dropped_scene(seed);
    const double range_m = seed % 2 == 0 ? 1.0 : 0.1;
    DepthImage all_m = scene.obstacles.depth_m;
    find_rejected(scene.sensor_depth_m, scene.obstacles, rejected);
    searchable.build(rejected.depth_m);
    for (int i = 0; i < kDroppedWidth_px * kDroppedHeight_px; ++i) {
      const float depth_m = rejected.depth_m.pixels()[i];
      if (!std::isnan(depth_m)) all_m.pixels()[i] = depth_m;
    }
    const LinkDistances kept = distances_to(scene, scene.obstacles.depth_m, range_m);
    const LinkDistances all = distances_to(scene, all_m, range_m);
    // Nothing of an answer before may stay.
    LinkVisibility before;
    before.rejected_distance_m = 0.001F;
    std::vector<LinkVisibility> links(kDroppedLinks, before);
    find_rejected_distances(scene.images.camera, scene.images.robot, rejected, searchable, kept,
                            range_m, workspace, links);
    for (int i = 0; i < kDroppedLinks; ++i) {
      if (std::isnan(links[i].rejected_distance_m)) {
        ++none;
        EXPECT_EQ(kept.links[i].status, all.links[i].status);
        if (kept.links[i].status == LinkStatus::ok) {
          EXPECT_NEAR(kept.links[i].distance_m, all.links[i].distance_m, 1e-5);
        }
        EXPECT_EQ(links[i].rejected_pixel, Pixel());
        continue;
      }
      ++rejected_readings;
      EXPECT_NEAR(links[i].rejected_distance_m, all.links[i].distance_m, 1e-5);
      const Pixel p = links[i].rejected_pixel;
      EXPECT_FALSE(std::isnan(rejected.depth_m(p.u, p.v)));
    }
  }
  EXPECT_GT(rejected_readings, 20);
  EXPECT_GT(none, 20);
}

}  // namespace
}  // namespace berth::testing
