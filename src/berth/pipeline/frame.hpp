#pragma once

#include "berth/distance/mesh/mean_directions.hpp"
#include "berth/distance/mesh/view_space.hpp"
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
  /// Of obstacles.depth_m; its tree is there unless the method is `mesh`.
  SearchableDepth searchable;
  /// Empty unless EvaluationSettings::visibility is set.
  DoubtfulImage doubtful;

  // For method `mesh` alone:

  /// What the image says of the space before the camera.
  ViewSpace space;
  /// For mean directions, where the settings ask for them.
  ReadingTiles reading_tiles;
  /// The readings that are doubtful; only where there are any.
  ViewSpace doubtful_space;
  bool has_doubtful_space = false;
  /// Whether a smaller share than kLeastReadings of the sensor's pixels has a reading: a camera
  /// that is covered, or failed.
  bool is_blind = false;
};

inline constexpr double kLeastReadings = 0.01;

/// Empties the images of a frame whose time is not ok, so that no older image stays under the new
/// stamp.
void clear_images(const Camera& camera, Frame& frame);

}  // namespace berth
