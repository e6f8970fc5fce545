#pragma once

#include <array>
#include <optional>
#include <string_view>
#include <vector>

#include "berth/types/setting.hpp"

namespace berth {

/// What is done where it is not known how near something is.
enum class UnknownPolicy {
  stop,          ///< the robot stops
  assume_range,  ///< something is assumed to stand there: at the distance of what is rejected or
                 ///< unknown, else at SeparationSettings::assumed_range_m
  ignore,        ///< only what is known counts
};
inline constexpr std::array kUnknownPolicies = {UnknownPolicy::stop, UnknownPolicy::assume_range,
                                                UnknownPolicy::ignore};
constexpr std::string_view name_of(UnknownPolicy policy) {
  constexpr std::array<std::string_view, 3> kNames = {"stop", "assume_range", "ignore"};
  return kNames[static_cast<std::size_t>(policy)];
}
constexpr const auto& all_of(UnknownPolicy) { return kUnknownPolicies; }

/// A row of a robot maker's table: from this speed, the robot stands still after that time and that
/// way.
struct StoppingRow {
  double speed_m_s = 0;
  double time_s = 0;
  double distance_m = 0;
};

/// What the protective separation distance is made from (ISO/TS 15066, 5.5.4).
struct SeparationSettings {
  /// v_h: how fast a person may come nearer.
  double human_speed_m_s = 1.6;
  /// From the request to the moment at which the robot begins to brake, or to obey a new speed:
  /// the answer itself, its way to the controller, the controller. The age of the images is added.
  double reaction_time_s = 0.1;
  /// How fast a robot that brakes loses speed; T_s = v / a and S_s = v^2 / 2a. Not used where there
  /// is a table.
  double deceleration_m_s2 = 2;
  /// From the robot's data, in place of the deceleration, by increasing speed. Linear between rows;
  /// below the first row as there; above the last one no speed is safe.
  std::vector<StoppingRow> stopping;
  /// How fast the robot may gain speed during the reaction time.
  double acceleration_m_s2 = 2;
  /// C: how far a part of a body may reach before it is detected. 8 (d - 14 mm) for what detects
  /// things of d = 40 mm (ISO 13855).
  double intrusion_m = 0.2;
  /// Z_d; none: from the settings of the cameras in use (camera_uncertainty_m()).
  std::optional<double> camera_uncertainty_m = std::nullopt;
  /// Z_r: how wrong the robot's place may be, the camera's pose included.
  double robot_uncertainty_m = 0.01;
  /// Whether only the part of a link's velocity counts that is directed at its closest obstacle,
  /// instead of the speed in any direction. It says nothing of the second closest one.
  bool directed_speed = false;
  /// The scale rises again only once the margin is larger than needed by this ...
  double release_m = 0.05;
  /// ... for so long.
  double hold_s = 0.3;
  /// A scale below this is 0: the robot stops.
  double least_scale = 0.05;
  /// A link is not seen enough where a smaller share of its surface is seen.
  double least_seen = 0.25;
  /// The policies, by what is not known.
  UnknownPolicy not_seen = UnknownPolicy::stop;
  UnknownPolicy camera = UnknownPolicy::stop;
  /// What the filter drops for being small is what intrusion_m is for. Counted, single false
  /// readings at outlines, as all cameras have them, stop the robot for good.
  UnknownPolicy rejected = UnknownPolicy::ignore;
  UnknownPolicy unknown = UnknownPolicy::assume_range;
  double assumed_range_m = 0.3;
};

/// The list of these settings but the table of stops.
template <SettingsOf<SeparationSettings> Settings, class Visitor>
void visit_settings(Settings& s, Visitor&& visit) {
  visit({"human_speed_m_s", kNotNegative, "how fast a person may come nearer"}, s.human_speed_m_s);
  visit({"reaction_time_s", kNotNegative,
         "from the request until the robot obeys; the age of the images is added"},
        s.reaction_time_s);
  visit({"deceleration_m_s2", kAboveZero,
         "how fast a robot that brakes loses speed, where there is no table `stopping`"},
        s.deceleration_m_s2);
  visit({"acceleration_m_s2", kNotNegative,
         "how fast the robot may gain speed during the reaction time"},
        s.acceleration_m_s2);
  visit({"intrusion_m", kNotNegative, "how far a part of a body may reach before it is detected"},
        s.intrusion_m);
  visit({"camera_uncertainty_m", kNotNegative,
         "how wrong a camera's readings may be; none: from tolerance, padding and noise of the "
         "cameras in use"},
        s.camera_uncertainty_m);
  visit({"robot_uncertainty_m", kNotNegative, "how wrong the robot's place may be"},
        s.robot_uncertainty_m);
  visit({"directed_speed", {}, "count only the speed towards the closest obstacle"},
        s.directed_speed);
  visit({"release_m", kNotNegative, "the speed rises again where this much more room is left"},
        s.release_m);
  visit({"hold_s", kNotNegative, "and has been for so long"}, s.hold_s);
  visit({"least_scale", {.most = 1}, "a smaller scale of the speed is a stop"}, s.least_scale);
  visit({"least_seen", {.most = 1}, "a link of which a smaller share is seen is not seen enough"},
        s.least_seen);
  visit({"not_seen", {}, "what to do where a link is not seen enough"}, s.not_seen);
  visit({"camera", {}, "what to do where a camera is not used, or covered"}, s.camera);
  visit({"rejected", {}, "what to do where a dropped reading is nearer than the distance"},
        s.rejected);
  visit({"unknown", {}, "what to do where unknown space is nearest"}, s.unknown);
  visit({"assumed_range_m", kNotNegative,
         "where something is assumed to stand beside a link that is not seen, or every link if a "
         "camera is lost"},
        s.assumed_range_m);
}

/// Throws std::invalid_argument that names key, value and what was expected.
void validate(const SeparationSettings& settings);

}  // namespace berth
