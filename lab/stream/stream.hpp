// A running robot: images at their own stamps, and requests by the clock.
#pragma once

#include <filesystem>
#include <string>

namespace berth::lab {

struct StreamSettings {
  std::filesystem::path scene;
  /// How many of the scene's cameras take part, the first ones; 0 for all.
  int cameras = 0;
  /// Requests a second.
  double rate_hz = 1000;
  double seconds = 10;
  /// How many times as fast as it was recorded.
  double speed = 3;
  bool as_json = false;
};

/// Plays the scene to and fro in real time: one thread gives joints, at the requests' rate, and
/// images as a driver does, each camera has its thread, and one thread asks. Returns what came
/// of it, in lines or as one JSON object. Throws std::runtime_error where the scene cannot be read
/// or played.
std::string run_stream(const StreamSettings& settings);

}  // namespace berth::lab
