#include "berth/fit/frame_drawer.hpp"

#include <gtest/gtest.h>

namespace berth {
namespace {

CalibrationCamera numbered(int width, int height) {
  CalibrationCamera camera;
  camera.camera = {width, height, 100, 110, 0.5 * (width - 1) + 0.3, 0.5 * (height - 1) - 0.2};
  CalibrationFrame& frame = camera.frames.emplace_back();
  frame.depth_m.resize(width, height, 0);
  for (std::size_t i = 0; i < frame.depth_m.pixels().size(); ++i) {
    frame.depth_m.pixels()[i] = static_cast<float>(i);
  }
  return camera;
}

TEST(ImageLevel, APointLiesInThePixelThatItsReadingCameFrom) {
  for (const int step : {1, 2, 3, 4, 5, 8}) {
    SCOPED_TRACE(step);
    const CalibrationCamera camera = numbered(37, 29);
    const ImageLevel level = make_level(camera, step);
    ASSERT_EQ(level.step, step);
    ASSERT_EQ(level.depth_m.size(), 1U);
    const DepthImage& small = level.depth_m[0];
    ASSERT_EQ(small.width(), 37 / step);
    ASSERT_EQ(small.height(), 29 / step);
    EXPECT_EQ(level.camera.width_px, small.width());
    EXPECT_EQ(level.camera.height_px, small.height());
    for (int v = 0; v < small.height(); ++v) {
      for (int u = 0; u < small.width(); ++u) {
        const Eigen::Vector3d p_C_m((u - level.camera.cx_px) / level.camera.fx_px,
                                    (v - level.camera.cy_px) / level.camera.fy_px, 1);
        const ImagePoint at = project(camera.camera, p_C_m);
        // The middle of a pixel of the sensor, not a place between two.
        EXPECT_NEAR(at.u, std::round(at.u), 1e-9);
        EXPECT_NEAR(at.v, std::round(at.v), 1e-9);
        const auto source = pixel_of(camera.camera, p_C_m);
        ASSERT_TRUE(source);
        EXPECT_EQ(small(u, v), camera.frames[0].depth_m(source->u, source->v));
      }
    }
  }
}

}  // namespace
}  // namespace berth
