#pragma once

#include <vector>

#include "berth/robot/kinematics.hpp"
#include "berth/types/link_distance.hpp"
#include "berth/types/link_visibility.hpp"
#include "berth/visibility/line_of_sight.hpp"
#include "berth/visibility/sample_points.hpp"

namespace berth {

/// The robot that the distances are about: at the pose of the exposure or at another one.
struct AskedRobot {
  const RobotPose& pose;
  /// The camera's pose in the root link when the image was exposed.
  const Pose& X_BC;
  /// Rendered at `pose`.
  const RobotImage& image;
};

/// The memory of find_visibility(), made once and used for every request; one for each thread.
struct VisibilityWorkspace {
  /// The points of one link that the robot image shows.
  std::vector<Eigen::Vector3d> drawn_C_m;
};

/// How much the camera sees of each link and of the space around its answer. `points` belong to
/// `model`; `distances` are the answer for `robot.image` and frame.obstacles within range_m. Each
/// share is counted on kSamplePoints points. Writes out[i], the link with the id i + 1, but not its
/// rejected distance. Allocates nothing once workspace and `out` have grown to the robot.
void find_visibility(const RobotModel& model, const SamplePoints& points, const SeenFrame& frame,
                     const AskedRobot& robot, const LinkDistances& distances, double range_m,
                     VisibilityWorkspace& workspace, std::vector<LinkVisibility>& out);

}  // namespace berth
