// How fast the robot may go, and why not faster.
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <string>
#include <string_view>
#include <vector>

#include "berth/types/robot_image.hpp"

namespace berth {

enum class SeparationState : std::uint8_t {
  clear,          ///< the robot may move as it does
  reduced,        ///< it may move at a smaller speed
  stop,           ///< it has to stand still
  contact_speed,  ///< it would have to stand still, but for SeparationSettings::contact_speed_m_s
};
/// By enumerator.
inline constexpr std::array<std::string_view, 4> kSeparationStateNames = {"clear", "reduced",
                                                                          "stop", "contact_speed"};

constexpr std::string_view name_of(SeparationState state) {
  return kSeparationStateNames[static_cast<std::size_t>(state)];
}

/// What keeps the robot from going faster.
enum class SeparationReason : std::uint8_t {
  none,         ///< nothing does
  occupied,     ///< something that a camera sees is near
  unknown,      ///< something may be in space that no camera sees
  unobserved,   ///< something may be in space that is in no camera's image
  rejected,     ///< a reading that the filter dropped may be a thing
  range,        ///< nothing is near, but nothing is known beyond the range either
  cut_short,    ///< a deadline cut the search: how near something is was not found out
  not_seen,     ///< the cameras see too little of the link
  camera,       ///< a camera is not used, or covered
  no_reading,   ///< something that gives no reading, such as black clothes, may be near: a camera
                ///< does not know where it could read
  stale,        ///< the result is too old, or its stamps are wrong
  velocity,     ///< the robot's velocity is not known
  speeding_up,  ///< nothing does any more, but no robot gains speed faster
};
/// By enumerator.
inline constexpr std::array<std::string_view, 13> kSeparationReasonNames = {
    "none",     "occupied", "unknown",    "unobserved", "rejected", "range",      "cut_short",
    "not_seen", "camera",   "no_reading", "stale",      "velocity", "speeding_up"};

constexpr std::string_view name_of(SeparationReason reason) {
  return kSeparationReasonNames[static_cast<std::size_t>(reason)];
}

/// What the scale was shown by.
enum class SeparationBasis : std::uint8_t {
  formula,  ///< as if the robot ran straight at what is nearest
  path,     ///< along the way that it takes until it stands
};
/// By enumerator.
inline constexpr std::array<std::string_view, 2> kSeparationBasisNames = {"formula", "path"};

constexpr std::string_view name_of(SeparationBasis basis) {
  return kSeparationBasisNames[static_cast<std::size_t>(basis)];
}

/// One link's part. Lengths and speeds are NaN where they are not known.
struct LinkSeparation {
  LinkId id = kNoLink;
  /// Whether a joint moves it. One that none does need not keep any distance, and has none here.
  bool is_moved = false;
  /// v_r: of its fastest point, with what it may gain during the reaction time, at scale 1.
  double speed_m_s = std::numeric_limits<double>::quiet_NaN();
  /// How near something may be, after the policies.
  double distance_m = std::numeric_limits<double>::quiet_NaN();
  /// S, at scale 1, as if the robot ran straight at what is nearest.
  double required_m = std::numeric_limits<double>::quiet_NaN();
  /// distance_m - required_m.
  double margin_m = std::numeric_limits<double>::quiet_NaN();
  /// The greatest scale of the robot's velocity that this link allows.
  double speed_scale = 0;
  SeparationReason reason = SeparationReason::none;
};

/// The fields of one link's part.
template <class Visitor>
void visit_fields(const LinkSeparation& l, Visitor&& visit) {
  visit({"speed_m_s", "the speed of the link's fastest point, with what it may gain"}, l.speed_m_s);
  visit({"distance_m", "how near something may be, after the policies for what is not known"},
        l.distance_m);
  visit({"required_m", "the protective separation distance"}, l.required_m);
  visit({"margin_m", "the distance less the protective separation distance"}, l.margin_m);
  visit({"speed_scale", "the greatest share of the robot's speed that the link allows"},
        l.speed_scale);
  visit({"reason", "why the share of the robot's speed is below 1"}, l.reason);
}

/// What a monitor says.
struct Separation {
  SeparationState state = SeparationState::stop;
  SeparationBasis basis = SeparationBasis::formula;
  /// By which the joint velocities that were given are to be multiplied, 0 to 1.
  double speed_scale = 0;
  /// Why it is not larger, and the link that says so; kNoLink where it is no link.
  SeparationReason reason = SeparationReason::stale;
  LinkId link = kNoLink;
  /// The camera that is not used, or else the one that does not tell what gives no reading, by its
  /// place in the request; -1 where neither counts.
  int camera = -1;
  /// T_r; NaN where it is not known.
  double reaction_time_s = std::numeric_limits<double>::quiet_NaN();
  /// links[i] has the id i + 1.
  std::vector<LinkSeparation> links;
};

}  // namespace berth
