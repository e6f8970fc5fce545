#pragma once

#include <array>
#include <optional>
#include <string_view>
#include <vector>

#include "berth/types/setting.hpp"

namespace berth {

/// The policy where it is not known how near something is.
enum class UnknownPolicy {
  stop,          ///< the robot stops
  assume_range,  ///< something is assumed to stand there: at the distance of what is rejected or
                 ///< unknown, else at SeparationSettings::assumed_range_m
  ignore,        ///< only what is known counts
};
inline constexpr std::array kUnknownPolicies = {UnknownPolicy::stop, UnknownPolicy::assume_range,
                                                UnknownPolicy::ignore};  ///< all of them
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

/// C where nobody has shown what the cameras detect: an arm's length (ISO 13855).
inline constexpr double kUnprovenIntrusion_m = 0.85;

/// A smaller scale of the speed is a stop.
inline constexpr double kLeastScale = 0.05;

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
  /// C: how far a part of a body may reach before it is detected; none: from detection_m.
  std::optional<double> intrusion_m = std::nullopt;
  /// d: the smallest thing that the cameras together were shown to detect everywhere in the cell;
  /// none: nobody has shown it. C = 8 (d - 14 mm) up to 40 mm, else kUnprovenIntrusion_m. Where a
  /// camera's SpaceSettings::detection_capability_m is more, that counts.
  std::optional<double> detection_m = std::nullopt;
  /// Z_d; none: from the settings of the cameras in use (camera_uncertainty_m()).
  std::optional<double> camera_uncertainty_m = std::nullopt;
  /// Z_r: how wrong the robot's place may be, the camera's pose included.
  double robot_uncertainty_m = 0.01;
  /// The robot need not be slower than this, of its fastest point, where its owner has judged a
  /// contact at this speed tolerable; 0: it has to stand. It stands all the same where a camera or
  /// the joints are not in order, a link is not seen, or it holds something sharp.
  double contact_speed_m_s = 0;
  /// A link is not seen enough where a smaller share of its surface is seen. No setting: nobody
  /// can choose it.
  double least_seen = 0.25;
  /// The policies, by what is not known.
  UnknownPolicy not_seen = UnknownPolicy::stop;
  UnknownPolicy camera = UnknownPolicy::stop;
  /// What gives no reading, such as black clothes, where a camera neither knows its empty cell
  /// (SensorSettings::background_frames) nor is told what no reading means
  /// (SpaceSettings::no_reading). None: nobody has chosen, and the robot stops.
  std::optional<UnknownPolicy> no_reading = std::nullopt;
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
  visit({"intrusion_m", kNotNegative,
         "how far a part of a body may reach before it is detected; none: from `detection_m`"},
        s.intrusion_m);
  visit({"detection_m", kAboveZero,
         "the smallest thing that the cameras were shown to detect; none: nobody has shown it, and "
         "`intrusion_m` is 0.85"},
        s.detection_m);
  visit({"camera_uncertainty_m", kNotNegative,
         "how wrong a camera's readings may be; none: from tolerance, padding and noise of the "
         "cameras in use"},
        s.camera_uncertainty_m);
  visit({"robot_uncertainty_m", kNotNegative, "how wrong the robot's place may be"},
        s.robot_uncertainty_m);
  visit({"contact_speed_m_s", kNotNegative,
         "the robot need not be slower than this; 0: it has to stand"},
        s.contact_speed_m_s);
  visit({"not_seen", {}, "what to do where less than a quarter of a link is seen"}, s.not_seen);
  visit({"camera", {}, "what to do where a camera is not used, or covered"}, s.camera);
  visit(
      {"no_reading",
       {},
       "what to do about black clothes and all that gives no reading, where a camera knows neither "
       "its empty cell nor what no reading means; none: a scene with such a camera is refused"},
      s.no_reading);
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
