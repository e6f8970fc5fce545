#pragma once

#include <cstdint>
#include <vector>

#include "berth/sensor/background.hpp"
#include "berth/sensor/holes.hpp"
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

/// Scratch of apply_sensor_rules; one for each camera.
struct SensorWorkspace {
  SpeckleWorkspace speckle;
  HolesWorkspace holes;
};

/// Applies the rules for what sensors do wrong to the self filter's result `out`, in this order:
/// speckle is dropped, the background is put where F has
/// no depth, holes are found. Depth, fates and counts of `out` tell what became of each pixel. All
/// images have the camera's size. The result does not depend on the number of threads.
void apply_sensor_rules(const Camera& camera, DepthView sensor_depth_m, const RobotImage& robot,
                        const KnownPlace& place, const SensorSettings& settings,
                        SensorWorkspace& workspace, ObstacleImage& out);

}  // namespace berth
