// Robots made of a few shapes, without files.
#pragma once

#include <random>
#include <vector>

#include "berth/robot/kinematics.hpp"
#include "berth/robot/robot_model.hpp"

namespace berth {

/// One link of each mesh, hanging on the first; all evaluated, with the ids 1, 2, ...
RobotModel robot_of(std::vector<TriangleMesh> meshes);

/// Changes the last link's role; the ids of the others stay.
void set_last_role(RobotModel& model, LinkRole role);

/// The robot's pose of links that stand at X_CL in the camera's frame.
RobotPose pose_seen_at(const Pose& X_BC, const std::vector<Pose>& X_CL);

inline Pose at(double x_m, double y_m, double z_m) {
  return Pose(Eigen::Translation3d(x_m, y_m, z_m));
}

Pose random_pose(std::mt19937& random, const Eigen::AlignedBox3d& positions);

/// Boxes, cylinders, spheres and clouds of single triangles, 2 cm to 1 m large.
TriangleMesh random_mesh(std::mt19937& random);

}  // namespace berth
