// Inside pipeline/ and for who looks into a frame: what one image says of the space before the
// camera.
#pragma once

#include "berth/distance/mean_directions.hpp"
#include "berth/pipeline/frame.hpp"
#include "berth/sensor/phantoms.hpp"
#include "berth/space/camera_space.hpp"
#include "berth/visibility/rejected.hpp"

namespace berth {

struct FrameSpace {
  CameraSpace seen;
  /// For mean directions, where the settings ask for them.
  ReadingTiles reading_tiles;
  /// Empty unless EvaluationSettings::visibility is set.
  RejectedImage rejected;
  /// The readings that are rejected; only where there are any.
  CameraSpace rejected_space;
  bool has_rejected_space = false;
  /// Scratch.
  PhantomWorkspace phantoms;
};

/// Nothing stays of the space of an image before.
inline void clear_space(FrameSpace& space) {
  space.seen.obstacle_depth_m = {};
  space.has_rejected_space = false;
}

/// Makes of a frame's images what they say of space. `sensor_depth_m` is the image that
/// frame.obstacles was made of.
void prepare_frame(DepthView sensor_depth_m, const EnvironmentSurfaces& environment, Frame& frame);

}  // namespace berth
