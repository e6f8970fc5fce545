#pragma once

#include <cstdint>
#include <optional>

namespace berth {

/// What a camera's pixel without a reading says of its line of sight.
enum class NoReading : std::uint8_t {
  unknown,  ///< nothing: it frees nothing that another camera's obstacle hides
  free,     ///< nothing stands there, for a camera that sees no background within its range
};

/// What a camera's readings say of space.
struct SpaceSettings {
  /// t: how thick a surface is that a camera measured. What lies deeper is hidden.
  double slab_m = 0.03;
  /// m: a reading frees what is nearer to the camera than it by more than this.
  double carve_margin_m = 0.02;
  /// rho: where the self filter took a reading for the robot, what is up to this far behind it is
  /// free as well: what the robot hides is no obstacle.
  double behind_robot_m = 0.3;
  NoReading no_reading = NoReading::unknown;
  /// A frame frees nothing once it is older than the newest one by more than this.
  double carve_max_age_s = 0.2;
  /// v: how fast something may have come into space that an older frame saw free.
  double obstacle_speed_m_s = 1.6;
};

/// What is asked of mesh_distances().
struct MeshQuestion {
  /// L: a distance above it is no answer.
  double range_m = 1.0;
  /// The search ends once no obstacle can be nearer to a link than the pair found by more than
  /// this.
  double tolerance_m = 0.001;
  /// The search ends this many microseconds after it began, with what it has found by then.
  std::optional<double> deadline_us = std::nullopt;
  /// Whether hidden space is asked for; without it `nearest` is `reading`.
  bool hidden = true;
};

/// Both throw std::invalid_argument that names key, value and what was expected.
void validate(const SpaceSettings& settings);
void validate(const MeshQuestion& question);

}  // namespace berth
