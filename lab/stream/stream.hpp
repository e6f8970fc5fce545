// A running robot: images at their own stamps, and requests by the clock.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

namespace berth::lab {

/// A drawn room instead of what a scene filmed.
struct RoomSettings {
  std::uint32_t seed = 1;
  int width_px = 640;
  int height_px = 480;
};

struct StreamSettings {
  std::filesystem::path scene;
  /// How many of the scene's cameras take part, the first ones; 0 for all. In a room any number.
  int cameras = 0;
  /// With the scene's robot and settings.
  std::optional<RoomSettings> room = std::nullopt;
  /// Requests a second.
  double rate_hz = 1000;
  double seconds = 10;
  /// How many times as fast as it was recorded.
  double speed = 3;
  /// So often a second a planner makes a field of the newest images and asks about 10 000
  /// configurations, on all cores; 0: nobody plans.
  double plans_hz = 0;
  /// All of it is recorded, and a recording of the last seconds is written here; empty: nothing is.
  std::filesystem::path record = {};
  /// Not in real time: the processor time of each step.
  bool in_steps = false;
  bool as_json = false;
};

/// Plays the scene forth and back in real time: one thread gives joints, at the requests' rate, and
/// images as a driver does, each camera has its thread, and one thread asks. Returns what came
/// of it, in lines or as one JSON object. Throws std::runtime_error where the scene cannot be read
/// or played.
std::string run_stream(const StreamSettings& settings);

}  // namespace berth::lab
