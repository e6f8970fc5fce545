// The search by tiles against every robot pixel, on random images.
#include <gtest/gtest.h>

#include <Eigen/Core>
#include <algorithm>
#include <random>
#include <vector>

#include "berth/self_filter/robot_neighbourhood.hpp"

namespace berth {
namespace {

Eigen::Vector3d point_C(const Camera& c, int u, int v, double z) {
  return {(u - c.cx_px) * z / c.fx_px, (v - c.cy_px) * z / c.fy_px, z};
}

std::vector<Eigen::Vector3d> surface_C(const Camera& camera, const RobotImage& robot) {
  std::vector<Eigen::Vector3d> points_C;
  for (int v = 0; v < camera.height_px; ++v) {
    for (int u = 0; u < camera.width_px; ++u) {
      const LinkId id = robot.link_id(u, v);
      if (id == kNoLink || id == kEnvironmentLink) continue;
      points_C.push_back(point_C(camera, u, v, robot.depth_m(u, v)));
    }
  }
  return points_C;
}

bool is_near_any(const std::vector<Eigen::Vector3d>& points_C, const Eigen::Vector3d& p_C,
                 double radius_m) {
  return std::any_of(points_C.begin(), points_C.end(),
                     [&](const Eigen::Vector3d& q_C) { return (q_C - p_C).norm() <= radius_m; });
}

bool is_in_near_tile(const RobotNeighbourhood& neighbourhood, int u, int v) {
  for (int row = 0; row < neighbourhood.tile_rows(); ++row) {
    for (const PixelRect& tile : neighbourhood.near_tiles(row)) {
      if (u >= tile.u_begin && u < tile.u_end && v >= tile.v_begin && v < tile.v_end) return true;
    }
  }
  return false;
}

TEST(RobotNeighbourhood, AgreesWithEveryRobotPixel) {
  std::mt19937 random(7);
  const auto uniform = [&](double low, double high) {
    return std::uniform_real_distribution<>(low, high)(random);
  };
  for (int round = 0; round < 40; ++round) {
    // Now and then so large that the robot's tiles fill more than one pack of groups.
    const bool is_large = round % 10 == 9;
    const int scale = is_large ? 9 : 1;
    const double robot_share = is_large ? 0.002 : 0.05 * (round % 5);
    const Camera camera{scale * (33 + round % 9), scale * (25 + round % 7),
                        scale * uniform(20, 90),  scale * uniform(20, 90),
                        scale * uniform(-10, 50), scale * uniform(-10, 40)};
    RobotImage robot{DepthImage(camera.width_px, camera.height_px, kNoDepth),
                     Image<LinkId>(camera.width_px, camera.height_px, kNoLink)};
    DepthImage depth_m(camera.width_px, camera.height_px, kNoDepth);
    Image<PixelFate> fate(camera.width_px, camera.height_px, PixelFate::no_reading);
    for (int v = 0; v < camera.height_px; ++v) {
      for (int u = 0; u < camera.width_px; ++u) {
        if (uniform(0, 1) < robot_share) {
          robot.link_id(u, v) = uniform(0, 1) < 0.2 ? kEnvironmentLink : LinkId{1};
          robot.depth_m(u, v) = static_cast<float>(uniform(0.3, 1.5));
        }
        if (uniform(0, 1) < 0.5) {
          fate(u, v) = PixelFate::obstacle;
          depth_m(u, v) = static_cast<float>(uniform(0.05, 2));
        }
      }
    }
    const std::vector<Eigen::Vector3d> robot_C = surface_C(camera, robot);
    const double radius_m = uniform(0.01, 0.6);
    RobotNeighbourhood neighbourhood;
    Image<std::uint8_t> near(camera.width_px, camera.height_px, 0);
    neighbourhood.begin(camera, robot, radius_m);
    const int tile_rows = neighbourhood.tile_rows();
    for (int row = 0; row < tile_rows; ++row) neighbourhood.add_robot(row);
    neighbourhood.end_robot();
    for (int row = 0; row < tile_rows; ++row) neighbourhood.find_near(row, depth_m, fate, near);
    for (int v = 0; v < camera.height_px; ++v) {
      for (int u = 0; u < camera.width_px; ++u) {
        const bool expected = fate(u, v) == PixelFate::obstacle &&
                              is_near_any(robot_C, point_C(camera, u, v, depth_m(u, v)), radius_m);
        EXPECT_EQ(near(u, v) != 0, expected) << "round " << round << ", pixel " << u << ", " << v;
        if (expected) {
          EXPECT_TRUE(is_in_near_tile(neighbourhood, u, v));
        }
      }
    }
  }
}

}  // namespace
}  // namespace berth
