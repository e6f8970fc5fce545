// Where a frame stands in another one, and rotations as scene files and URDFs write them.
#pragma once

#include <Eigen/Geometry>

namespace berth {

/// X_BC: the pose of frame C in frame B.
using Pose = Eigen::Isometry3d;

/// A pose that nobody has set: NaN, so that it cannot pass for one.
Pose unset_pose();

/// About the fixed axes x, then y, then z.
Eigen::Quaterniond rotation_of_rpy(const Eigen::Vector3d& rpy_rad);

/// Such angles of a rotation. The one about x is taken from what the others leave, so that they
/// give the rotation where x is turned along z too.
Eigen::Vector3d rpy_of(const Eigen::Matrix3d& R);

}  // namespace berth
