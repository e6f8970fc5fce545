#include "tests/thesis/plain_definition.hpp"

#include <algorithm>
#include <cmath>

namespace berth::testing {

double plain_distance_m(const Camera& camera, Pixel robot, double robot_depth_m, Pixel obstacle,
                        double obstacle_depth_m) {
  const int robot_u = robot.u < obstacle.u ? robot.u + 1 : robot.u;
  const int robot_v = robot.v < obstacle.v ? robot.v + 1 : robot.v;
  const int obstacle_u = robot.u > obstacle.u ? obstacle.u + 1 : obstacle.u;
  const int obstacle_v = robot.v > obstacle.v ? obstacle.v + 1 : obstacle.v;
  const double d = std::max(robot_depth_m, obstacle_depth_m);
  const double cx = camera.cx_px + 0.5;
  const double cy = camera.cy_px + 0.5;
  const Eigen::Vector3d robot_C_m((robot_u - cx) * robot_depth_m / camera.fx_px,
                                  (robot_v - cy) * robot_depth_m / camera.fy_px, robot_depth_m);
  const Eigen::Vector3d obstacle_C_m((obstacle_u - cx) * d / camera.fx_px,
                                     (obstacle_v - cy) * d / camera.fy_px, d);
  return (obstacle_C_m - robot_C_m).norm();
}

std::optional<double> plain_least_distance_m(const sim::ImagePair& images, LinkId link) {
  std::optional<double> least_m;
  const RobotImage& robot = images.robot;
  const DepthImage& obstacle = images.obstacle_depth_m;
  for (int rv = 0; rv < obstacle.height(); ++rv) {
    for (int ru = 0; ru < obstacle.width(); ++ru) {
      if (robot.link_id(ru, rv) != link) continue;
      for (int ov = 0; ov < obstacle.height(); ++ov) {
        for (int ou = 0; ou < obstacle.width(); ++ou) {
          if (std::isnan(obstacle(ou, ov))) continue;
          const double distance_m = plain_distance_m(images.camera, {ru, rv}, robot.depth_m(ru, rv),
                                                     {ou, ov}, obstacle(ou, ov));
          if (!least_m || distance_m < *least_m) least_m = distance_m;
        }
      }
    }
  }
  return least_m;
}

}  // namespace berth::testing
