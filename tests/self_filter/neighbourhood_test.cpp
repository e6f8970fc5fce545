// The search by tiles against every robot pixel, on random images.
#include <gtest/gtest.h>

#include <Eigen/Core>
#include <random>

#include "berth/self_filter/robot_neighbourhood.hpp"

namespace berth {
namespace {

Eigen::Vector3d point_C(const Camera& c, int u, int v, double z) {
  return {(u - c.cx_px) * z / c.fx_px, (v - c.cy_px) * z / c.fy_px, z};
}

bool is_near_any(const Camera& camera, const RobotImage& robot, const Eigen::Vector3d& p_C,
                 double radius_m) {
  for (int v = 0; v < camera.height_px; ++v) {
    for (int u = 0; u < camera.width_px; ++u) {
      const LinkId id = robot.link_id(u, v);
      if (id == kNoLink || id == kEnvironmentLink) continue;
      if ((point_C(camera, u, v, robot.depth_m(u, v)) - p_C).norm() <= radius_m) return true;
    }
  }
  return false;
}

TEST(RobotNeighbourhood, AgreesWithEveryRobotPixel) {
  std::mt19937 random(7);
  const auto uniform = [&](double low, double high) {
    return std::uniform_real_distribution<>(low, high)(random);
  };
  for (int round = 0; round < 30; ++round) {
    const Camera camera{33 + round % 9,  25 + round % 7,   uniform(20, 90),
                        uniform(20, 90), uniform(-10, 50), uniform(-10, 40)};
    RobotImage robot{DepthImage(camera.width_px, camera.height_px, kNoDepth),
                     Image<LinkId>(camera.width_px, camera.height_px, kNoLink)};
    DepthImage depth_m(camera.width_px, camera.height_px, kNoDepth);
    Image<PixelFate> fate(camera.width_px, camera.height_px, PixelFate::no_reading);
    for (int v = 0; v < camera.height_px; ++v) {
      for (int u = 0; u < camera.width_px; ++u) {
        if (uniform(0, 1) < 0.05 * (round % 5)) {
          robot.link_id(u, v) = uniform(0, 1) < 0.2 ? kEnvironmentLink : LinkId{1};
          robot.depth_m(u, v) = static_cast<float>(uniform(0.3, 1.5));
        }
        if (uniform(0, 1) < 0.5) {
          fate(u, v) = PixelFate::obstacle;
          depth_m(u, v) = static_cast<float>(uniform(0.2, 2));
        }
      }
    }
    const double radius_m = uniform(0.01, 0.3);
    RobotNeighbourhood neighbourhood;
    Image<std::uint8_t> near;
    neighbourhood.build(camera, robot);
    neighbourhood.find_near(depth_m, fate, radius_m, near);
    for (int v = 0; v < camera.height_px; ++v) {
      for (int u = 0; u < camera.width_px; ++u) {
        const bool expected =
            fate(u, v) == PixelFate::obstacle &&
            is_near_any(camera, robot, point_C(camera, u, v, depth_m(u, v)), radius_m);
        EXPECT_EQ(near(u, v) != 0, expected) << "round " << round << ", pixel " << u << ", " << v;
      }
    }
  }
}

}  // namespace
}  // namespace berth
