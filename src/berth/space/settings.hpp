#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string_view>

#include "berth/types/camera.hpp"
#include "berth/types/setting.hpp"

namespace berth {

/// What a camera's pixel without a reading says of its line of sight.
enum class NoReading : std::uint8_t {
  unknown,  ///< nothing: it frees nothing that another camera's obstacle hides
  free,     ///< nothing stands there, for a camera that sees no background within its range
  hides,    ///< something may stand anywhere on it, for a camera that always has a reading
};

inline constexpr std::array kNoReadings = {NoReading::unknown, NoReading::free, NoReading::hides};
constexpr std::string_view name_of(NoReading meaning) {
  constexpr std::array<std::string_view, 3> kNames = {"unknown", "free", "hides"};
  return kNames[static_cast<std::size_t>(meaning)];
}
constexpr const auto& all_of(NoReading) { return kNoReadings; }

/// The status of space that is in no camera's image.
enum class Unobserved : std::uint8_t {
  ignore,   ///< nothing stands there, for a cell that nobody can enter unseen
  unknown,  ///< something may stand there, as behind what a camera sees
};

inline constexpr std::array kUnobserveds = {Unobserved::ignore, Unobserved::unknown};
constexpr std::string_view name_of(Unobserved meaning) {
  return meaning == Unobserved::ignore ? "ignore" : "unknown";
}
constexpr const auto& all_of(Unobserved) { return kUnobserveds; }

/// What a camera's readings say of space. The first three lengths are no settings, since nobody can
/// choose them: no list has them, and only the twins' tests vary them.
struct SpaceSettings {
  /// t: how thick a surface is that a camera measured. What lies deeper is hidden.
  double surface_thickness_m = 0.03;
  /// m: a reading frees what is nearer to the camera than it by more than this.
  double free_space_margin_m = 0.02;
  /// rho: where the self filter took a reading for the robot, what is up to this far behind it is
  /// free as well: what the robot hides is no obstacle. Environment is free up to its model's back,
  /// and at most so far.
  double behind_robot_m = 0.3;
  NoReading no_reading = NoReading::unknown;
  /// Of all cameras together; one that says `unknown` says it for all. None: it is no obstacle, but
  /// a link near much of it is LinkStatus::not_observed.
  std::optional<Unobserved> unobserved = std::nullopt;
  /// d: a ball of this diameter is the least thing that has to be told. What hides none of them
  /// from a camera does not hide: a pixel without a reading, a cable; 0 turns that off. None: what
  /// suits the camera (detection_capability_m()).
  std::optional<double> detection_capability_m = std::nullopt;
  /// v: how fast something may have come into space that an older frame saw free. No setting: the
  /// monitor counts human_speed_m_s times the frames' age besides.
  double obstacle_speed_m_s = 1.6;
};

/// The list of these settings.
template <SettingsOf<SpaceSettings> Settings, class Visitor>
void visit_settings(Settings& s, Visitor&& visit) {
  visit({"no_reading",
         {},
         "what a pixel without a reading says of its line of sight: free is for a camera that sees "
         "no background within its range, hides for one that reads all of the empty cell"},
        s.no_reading);
  visit({"unobserved",
         {},
         "what space that no camera's image shows counts as: unknown is an obstacle; none: no "
         "obstacle, but a link near much of it is not_observed"},
        s.unobserved);
  visit({"detection_capability_m", kNotNegative,
         "pixels without a reading, and thin things, hide nothing where no ball of this diameter "
         "fits behind them; 0 is off; none: 0.04, or what a coarse camera tells 3 m away"},
        s.detection_capability_m);
}

/// The diameter d of the least ball that this camera has to tell, by these settings. Where they say
/// none: that of the balls which outlines of two pixels without a reading cannot hide up to 3 m
/// away, in whole centimetres (the nearest) and at least 4: 4 cm with a focal length of 228 pixels
/// and more, 8 cm with 130.
double detection_capability_m(const SpaceSettings& settings, const Camera& camera);

/// Throws std::invalid_argument that names key, value and what was expected.
void validate(const SpaceSettings& settings);

}  // namespace berth
