// Depth images as messages and drivers carry them: bytes, rows of any length, two encodings.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>

#include "berth/files/depth_units.hpp"
#include "berth/types/camera.hpp"
#include "berth/types/image.hpp"
#include "berth/types/obstacle_image.hpp"

namespace berth {

/// An image in somebody else's memory, as sensor_msgs/Image describes it.
struct RawDepth {
  std::span<const std::uint8_t> bytes;
  int width_px = 0;
  int height_px = 0;
  /// From one row to the next.
  std::size_t row_bytes = 0;
  /// "16UC1" (or "mono16"): whole numbers, in units of DepthUnits::scale_m, 0 and 65535 = no
  /// reading. "32FC1": metres, where NaN, what is not above 0 and what is not below kMostReading_m
  /// are no reading.
  std::string_view encoding;
  bool is_bigendian = false;
};

/// Throws std::invalid_argument with the value and what was expected: another encoding, big-endian
/// numbers, another size than the camera's, rows that are too short, bytes that are missing.
void validate(const RawDepth& raw, const Camera& camera);

/// The image in metres, NaN where there is no reading. DepthUnits::scale_m is not applied to
/// 32FC1. Reuses the memory of `depth_m`. Throws as validate does.
void read_raw_depth(const RawDepth& raw, const Camera& camera, const DepthUnits& units,
                    DepthImage& depth_m);

/// The same image without what was not kept: bytes of `raw` where `obstacles` keeps a reading as it
/// is, the depth it gives instead where it keeps another one, else no reading. `out` has as many
/// bytes as `raw`, and its layout. Throws as validate does, and where sizes differ.
void write_raw_obstacles(const RawDepth& raw, const Camera& camera, const ObstacleImage& obstacles,
                         const DepthUnits& units, std::span<std::uint8_t> out);

}  // namespace berth
