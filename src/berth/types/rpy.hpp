// Rotations as scene files and URDFs write them.
#pragma once

#include <Eigen/Geometry>

namespace berth {

/// About the fixed axes x, then y, then z.
Eigen::Quaterniond rotation_of_rpy(const Eigen::Vector3d& rpy_rad);

/// Such angles of a rotation. The one about x is taken from what the others leave, so that they
/// give the rotation where x is turned along z too.
Eigen::Vector3d rpy_of(const Eigen::Matrix3d& R);

}  // namespace berth
