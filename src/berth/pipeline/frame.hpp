#pragma once

#include "berth/distance/searchable_depth.hpp"
#include "berth/pipeline/exposure.hpp"
#include "berth/types/obstacle_image.hpp"
#include "berth/types/robot_image.hpp"
#include "berth/visibility/doubtful.hpp"

namespace berth {

/// What one depth image tells, ready for any number of questions; constant while it is asked.
struct Frame : Exposure {
  /// The robot at that time.
  RobotImage robot;
  ObstacleImage obstacles;
  /// Of obstacles.depth_m.
  SearchableDepth searchable;
  /// Empty unless EvaluationSettings::visibility is set.
  DoubtfulImage doubtful;
};

/// Empties the images of a frame whose time is not ok, so that no older image stays under the new
/// stamp.
void clear_images(const Camera& camera, Frame& frame);

}  // namespace berth
