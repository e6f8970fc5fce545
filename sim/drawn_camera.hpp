// Cameras around a robot, and what an ideal one sees.
#pragma once

#include "berth/robot/kinematics.hpp"
#include "berth/types/camera.hpp"
#include "sim/embree_renderer.hpp"
#include "sim/random.hpp"

namespace berth::sim {

/// A camera that sees less than this share of its pixels filled by the robot is drawn again.
inline constexpr double kLeastRobotShare = 0.01;
/// No obstacle comes nearer to a camera.
inline constexpr double kLeastCameraClearance_m = 0.25;

/// A ball around the evaluated links, and the lowest point of all links.
struct RobotExtent {
  Eigen::Vector3d centre_B_m;
  double radius_m;
  double lowest_z_m;
};
RobotExtent extent_of(const RobotModel& model, const RobotPose& pose);

Camera draw_camera(Random& random, int width_px, int height_px);

/// Around the robot, from a little below its middle up to steeply above.
Pose draw_camera_pose(Random& random, const RobotExtent& robot);

/// What Embree's rays meet at the pixels' centres.
RobotImage cast_image(const EmbreeRenderer& rays, const Camera& camera);

/// The share of the pixels that show an evaluated link.
double robot_share(const RobotImage& image);

}  // namespace berth::sim
