#pragma once

#include <cstdint>
#include <vector>

#include "berth/sensor/settings.hpp"
#include "berth/types/obstacle_image.hpp"

namespace berth {

struct SpeckleWorkspace {
  /// The state of each pixel.
  Image<std::uint8_t> state;
  /// Pixels of the blob that is being walked.
  std::vector<Pixel> blob;
};

/// Drops as `speckle` the `obstacle` pixels of blobs of fewer than speckle_px pixels (8 neighbours,
/// joined as one surface is (joined.hpp)).
void drop_speckle(const SensorSettings& settings, SpeckleWorkspace& workspace, ObstacleImage& out);

}  // namespace berth
