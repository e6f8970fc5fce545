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
/// them, if that is nearer; its fate is `averaged` then. The mean goes back only as far as the
/// pixel showed an obstacle within noise of the newest reading: after a jump it begins anew. Never
/// moves anything away, and nothing by more than the noise. The image is taken into the history
/// first; an image of another size empties the history.
void average_readings(const SensorSettings& settings, ReadingHistory& history, ObstacleImage& out);

}  // namespace berth
