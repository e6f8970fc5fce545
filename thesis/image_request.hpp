#pragma once

#include "berth/types/camera.hpp"
#include "berth/types/robot_image.hpp"
#include "thesis/searchable_depth.hpp"
#include "thesis/settings.hpp"

namespace berth {

/// What every method answers: the distances between the links of one image and what may be an
/// obstacle in another. Both images have the camera's size.
struct ImageRequest {
  const Camera& camera;
  /// Link ids go from 1 to link_count. Pixels of kEnvironmentLink are not evaluated; any other id
  /// is a programming error.
  const RobotImage& robot;
  int link_count;
  /// NaN where nothing is. `exact` and mean directions need its tree.
  const SearchableDepth& obstacles;
  const ImageDistanceSettings& settings;
};

}  // namespace berth
