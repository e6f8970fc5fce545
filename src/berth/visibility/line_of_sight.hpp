// Inside visibility/ only: what stands on the line of sight to a point.
#pragma once

#include <Eigen/Core>

#include "berth/self_filter/settings.hpp"
#include "berth/types/camera.hpp"
#include "berth/types/depth_units.hpp"
#include "berth/types/link_visibility.hpp"
#include "berth/types/obstacle_image.hpp"
#include "berth/types/robot_image.hpp"

namespace berth {

/// One depth image after the self filter: the robot as it stood at the exposure, the obstacles,
/// each pixel's fate. All images have the camera's size.
struct SeenFrame {
  const Camera& camera;
  const RobotImage& robot;
  const ObstacleImage& obstacles;
  /// The self filter's own.
  Tolerance tolerance;
};

/// A point of a link's surface in frame C, with its unit normal of either side.
struct LinkPoint {
  LinkId id;
  Eigen::Vector3d p_C_m;
  Eigen::Vector3d normal_C;
};

/// What the frame knows of a point in space. It is seen where the reading lies behind it; in front
/// of the robot only where it is nearer than the robot by more than the tolerance, because nearer
/// readings to the robot were removed with it.
Sight sight_of_space(const SeenFrame& frame, const Eigen::Vector3d& p_C_m);

/// A point of a surface, and the pixel that shows it.
struct SurfaceSight {
  Sight sight;
  /// Whether the robot image shows the point: seen, but for what the sensor reports.
  bool is_drawn;
};

/// What the frame knows of a point of a link. `robot` is rendered at the pose that the link has: at
/// that of the exposure or at another one. The point is hidden by the robot where the nearest
/// pixel, or one of the four around it that shows the point's own link, shows something in front of
/// the point's tangent plane by more than a pixel's width; or where the robot of the exposure stood
/// in front of it by more than the tolerance. Where none of the four shows its link it has no
/// reading.
SurfaceSight sight_of_surface(const SeenFrame& frame, const RobotImage& robot,
                              const LinkPoint& point);

/// One camera's frame for find_whole_robot_visibility().
struct SeeingCamera {
  SeenFrame frame;
  /// The raw image, rounded down.
  const UnitImage& sensor_depth;
  Pose X_CB;
};

}  // namespace berth
