#pragma once

#include <optional>
#include <stop_token>

#include "berth/types/setting.hpp"

namespace berth {

/// A search for more does not end in any time that somebody waits: the space that it looks through
/// grows with the third power. No depth camera sees so far.
inline constexpr Domain kRange{.is_open = true, .most = 50};

/// Settings of every way to find distances.
struct DistanceSettings {
  /// L: a distance above it is no answer. For images half the side of the region of surveillance
  /// (Hirt 2.2.3).
  double range_m = 1.0;
  /// Whether to give the mean direction of what is near (Hirt 2.2.5).
  bool mean_direction = true;
  /// The search may stop as soon as no pair of a link can be closer than the one found by more than
  /// this. Nothing: 1 mm for the whole robot, 0 for `exact`.
  std::optional<double> tolerance_m = std::nullopt;
  /// The search stops this many microseconds after it began, mean directions not counted, with what
  /// it has found by then.
  std::optional<double> deadline_us = std::nullopt;
  /// A link of whose surface the cameras see a smaller share is LinkStatus::not_seen.
  double min_seen_share = 0.02;

  bool operator==(const DistanceSettings&) const = default;
};

/// The list of these settings.
template <SettingsOf<DistanceSettings> Settings, class Visitor>
void visit_settings(Settings& s, Visitor&& visit) {
  visit({"range_m", kRange, "distances are looked for up to here"}, s.range_m);
  visit({"mean_direction", {}, "whether to give the mean direction of what is near each link"},
        s.mean_direction);
  visit({"tolerance_m", kNotNegative,
         "the search may stop once a link's distance is known to this; without it 0.001"},
        s.tolerance_m);
  visit({"deadline_us",
         {.may_be_infinite = true},
         "the search stops in time for a request to take this number of microseconds, and tells "
         "what it knows by then: distance and lower bound"},
        s.deadline_us);
  visit({"min_seen_share",
         {.most = 1},
         "a link of whose surface the cameras see a smaller share is not_seen"},
        s.min_seen_share);
}

/// Throws std::invalid_argument that names key, value and what was expected.
void validate(const DistanceSettings& settings);

/// The arguments of mesh_distances().
struct MeshRequest {
  /// L: a distance above it is no answer.
  double range_m = 1.0;
  /// The search ends once no obstacle can be nearer to a link than the pair found by more than
  /// this.
  double tolerance_m = 0.001;
  /// The search ends this many microseconds after it began, with what it has found by then.
  std::optional<double> deadline_us = std::nullopt;
  /// Whether unknown space is asked for; without it `nearest` is `occupied`.
  bool unknown = true;
  /// Once it says so the search ends, within milliseconds, as by a deadline; null: nobody stops it.
  const std::stop_token* stop = nullptr;
};

/// Throws std::invalid_argument that names key, value and what was expected.
void validate(const MeshRequest& request);

}  // namespace berth
