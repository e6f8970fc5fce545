#pragma once

#include <Eigen/Geometry>

namespace berth::sim {

/// The shortest turn of `from` onto `to`. Eigen's FromTwoVectors takes ten seconds to compile, and
/// is compiled here alone.
Eigen::Quaterniond turn_between(const Eigen::Vector3d& from, const Eigen::Vector3d& to);

}  // namespace berth::sim
