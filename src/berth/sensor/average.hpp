#pragma once

#include <vector>

#include "berth/sensor/settings.hpp"
#include "berth/types/obstacle_image.hpp"

namespace berth {

/// The obstacle images of the last frames; empty at first.
struct ReadingHistory {
  /// A ring: `newest` is the one written last.
  std::vector<DepthImage> depth_m;
  std::size_t newest = 0;
};

/// Moves each `obstacle` to the mean of its pixel's last average_frames readings, itself among
/// them, where that is nearer than itself: it is `averaged` then. The mean goes back as far as the
/// pixel showed an obstacle within noise of the reading, so that a jump begins anew. Never moves
/// anything away, and nothing by more than the noise. Takes the image into the history before that,
/// and forgets it all where the size changes.
void average_readings(const SensorSettings& settings, ReadingHistory& history, ObstacleImage& out);

}  // namespace berth
