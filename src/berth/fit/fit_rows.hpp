// For watch/ and calibration/: what each pixel says of an estimate, of depth and of outline.
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

struct OutlineRowLimits {
  /// How far the sensor's outline is looked for, on both sides of the model's.
  int reach_px = 10;
  /// A reading is like the robot where it differs from the model's depth by no more than this.
  double band_m = 0.05;
};

/// What was found at the model's outline.
struct OutlineCount {
  /// Places where the model's outline stands before nothing, or before something far behind it.
  int places = 0;
  /// Those where the sensor's outline was found.
  int found = 0;
};

/// One row for each place of the model's outline where the sensor's was found: the way between
/// both, across the outline, in metres at the model's depth. Appends to `rows`. `step` is how many
/// pixels of the sensor one of these images stands for.
OutlineCount append_outline_rows(const Camera& camera, DepthView depth_m, const RobotImage& robot,
                                 const CameraEstimate& estimate, int step,
                                 const OutlineRowLimits& limits, std::vector<FitRow>& rows);

}  // namespace berth
