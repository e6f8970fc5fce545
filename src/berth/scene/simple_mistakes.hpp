#pragma once

#include <string>
#include <vector>

#include "berth/scene/robot_in_images.hpp"

namespace berth {

/// One simple mistake in a scene, and what the scene would say without it.
struct SimpleMistake {
  /// Goes on after "probably ", such as "depth_scale is 0.001, not 0.01".
  std::string cause;
  /// Where to correct it: a file, or a camera of the scene.
  std::string place = {};
  CameraBelief corrected = {};
  /// It explains where the robot is if this share of its readings lies at its surface then, those
  /// that hide it left out.
  double least_share = 0.6;
  /// The joints are wrong, and so all cameras see the robot elsewhere.
  bool is_of_joints = false;
};

/// All that are tried for a camera of this scene: depth in other units or along the ray, other
/// intrinsics, a pose in other units, axes, order or direction, images that are mirrored, another
/// camera's, or one frame early or late, joints in other units or another order, or one joint's
/// unit, sign or zero.
std::vector<SimpleMistake> simple_mistakes(const OpenScene& scene, const RobotInImages& images);

/// The one of them that may leave all of the robot within kSeenThrough_m of its surface.
SimpleMistake depth_along_ray(const RobotInImages& images);

/// Those of them that leave most of the robot where it is: other intrinsics, and depth along the
/// ray.
std::vector<SimpleMistake> optical_mistakes(const OpenScene& scene, const RobotInImages& images);

}  // namespace berth
