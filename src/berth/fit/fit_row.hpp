// For watch/ and calibration/: one equation of the fit.
#pragma once

#include <Eigen/Core>

#include "berth/types/robot_image.hpp"

namespace berth {

/// What one pixel says: `residual` is 0 where model and reading agree.
struct FitRow {
  double residual_m = 0;
  /// The point of the model that it is about, and how the residual changes when that point moves.
  Eigen::Vector3d p_C_m = Eigen::Vector3d::Zero();
  Eigen::Vector3d per_move = Eigen::Vector3d::Zero();
  LinkId link = kNoLink;
  /// How it changes with the other unknowns of the camera.
  double per_depth_offset = 0;
  double per_depth_scale = 0;
  double per_dilation = 0;
};

}  // namespace berth
