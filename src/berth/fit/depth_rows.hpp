// For watch/ and calibration/.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "berth/fit/estimate.hpp"
#include "berth/types/image.hpp"
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

/// Which readings count as the robot's.
struct DepthRowLimits {
  /// Every Nth pixel of every Nth row.
  int stride = 1;
  /// Readings farther from the model than this, along the optical axis, are passed over.
  double cut_m = 0.03;
};

/// One row for each reading that may be the robot's: its way to the model's surface, along the
/// surface's normal. Appends to `rows`. Surfaces that are seen at a grazing angle are left out.
void append_depth_rows(const Camera& camera, DepthView depth_m, const RobotImage& robot,
                       const CameraEstimate& estimate, const DepthRowLimits& limits,
                       std::vector<FitRow>& rows);

}  // namespace berth
