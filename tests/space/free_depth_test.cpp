#include "berth/space/free_depth.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "tests/support/plain_distance.hpp"
#include "tests/support/thinned.hpp"

namespace berth::testing {
namespace {

TEST(FreeDepth, IsThatOfTheDefinition) {
  for (std::uint32_t seed = 0; seed < thinned(20u); ++seed) {
    MeshWorldSettings settings;
    settings.views = 1;
    settings.width_px = 9 + 4 * static_cast<int>(seed);
    settings.dropout = 0.03 * (seed % 4);
    settings.space.no_reading = seed % 5 == 0 ? NoReading::free : NoReading::unknown;
    MeshWorld world = draw_mesh_world(settings, seed);
    MeshWorldView& view = world.views[0];
    for (const double age_s : {0.0, 0.004, 0.02, 0.1, 0.2}) {
      SCOPED_TRACE("seed " + std::to_string(seed) + " age " + std::to_string(age_s));
      view.age_s = age_s;
      CameraSpace space;
      build_camera_space(view.camera, view.sensor_depth_m, view.obstacles, view.environment(),
                         world.settings, space);
      // A second view, since a single one is not asked what it frees.
      const PosedSpace posed[] = {{&space, view.X_BC, age_s}, {&space, view.X_BC, 0}};
      UnknownSpace hidden;
      hidden.assign(posed);
      const DepthWindows& found = *hidden.views()[0].free_depth;
      const Image<double> plain_m = plain_free_depth(view, world.settings);
      for (int v = 0; v < view.camera.height_px; ++v) {
        for (int u = 0; u < view.camera.width_px; ++u) {
          EXPECT_EQ(in_metres(found(u, v)), plain_m(u, v)) << u << " " << v;
        }
      }
    }
  }
}

TEST(FreeDepth, NothingIsFreedOnceAFrameIsTooOld) {
  MeshWorldSettings settings;
  settings.views = 2;
  MeshWorld world = draw_mesh_world(settings, 3);
  world.views[0].age_s = 0.21;
  const PreparedWorld prepared(world);
  EXPECT_EQ(prepared.space().views()[0].free_depth, nullptr);
  EXPECT_NE(prepared.space().views()[1].free_depth, nullptr);
}

TEST(FreeDepth, APointIsSeenFreeBeforeItsPixelsFreeDepth) {
  MeshWorldSettings settings;
  settings.views = 2;
  const MeshWorld world = draw_mesh_world(settings, 4);
  const PreparedWorld prepared(world);
  const FreeingCamera& view = prepared.space().views()[0];
  const Camera& camera = view.space->camera;
  int free_pixels = 0;
  for (int v = 0; v < camera.height_px; ++v) {
    for (int u = 0; u < camera.width_px; ++u) {
      const double free_m = in_metres(view.space->free_depth(u, v));
      const Eigen::Vector3d ray((u - camera.cx_px) / camera.fx_px,
                                (v - camera.cy_px) / camera.fy_px, 1);
      EXPECT_FALSE(is_seen_free(view, view.X_BC * (ray * (free_m + 1e-4))));
      EXPECT_FALSE(is_seen_free(view, view.X_BC * (ray * -0.1)));
      if (free_m <= 1e-3) continue;
      ++free_pixels;
      EXPECT_TRUE(is_seen_free(view, view.X_BC * (ray * (free_m - 1e-4))));
    }
  }
  EXPECT_GT(free_pixels, 20);
}

}  // namespace
}  // namespace berth::testing
