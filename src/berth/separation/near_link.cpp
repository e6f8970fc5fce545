#include "berth/separation/near_link.hpp"

#include <cmath>

namespace berth {
namespace {

SeparationReason reason_of(const LinkDistance& link) {
  switch (link.status) {
    case LinkStatus::none_in_range:
      return SeparationReason::range;
    case LinkStatus::cut_short:
      return SeparationReason::cut_short;
    default:
      break;
  }
  if (!link.has_distance()) return SeparationReason::range;
  return link.obstacle_kind == ObstacleKind::hidden ? SeparationReason::hidden
                                                    : SeparationReason::reading;
}

/// To what is seen alone.
NearLink near_reading(const LinkDistance& link) {
  return {link.reading.lower_bound_m,
          link.reading.is_known() ? SeparationReason::reading : SeparationReason::range};
}

/// By what is certified.
NearLink near_known(const SeparationSettings& settings, const LinkDistance& link, double range_m) {
  if (std::isnan(link.lower_bound_m)) return {range_m, SeparationReason::range};
  const NearLink known{link.lower_bound_m, reason_of(link)};
  if (known.reason != SeparationReason::hidden) return known;
  if (settings.hidden == UnknownPolicy::ignore) return near_reading(link);
  return with_unknown(known, settings.hidden, known.distance_m, SeparationReason::hidden);
}

bool is_seen_enough(const SeparationSettings& settings, const LinkDistance& link,
                    const LinkVisibility& visibility) {
  if (link.status == LinkStatus::not_seen || link.status == LinkStatus::not_visible) return false;
  return !visibility.surface.is_known() || visibility.surface.seen >= settings.least_seen;
}

}  // namespace

NearLink with_unknown(const NearLink& near, UnknownPolicy policy, double distance_m,
                      SeparationReason reason) {
  if (policy == UnknownPolicy::ignore) return near;
  if (policy == UnknownPolicy::stop) return {0, reason};
  return distance_m < near.distance_m ? NearLink{distance_m, reason} : near;
}

NearLink near_link(const SeparationSettings& settings, const LinkDistance& link,
                   const LinkVisibility& visibility, double range_m) {
  if (link.status == LinkStatus::untimely) return {0, SeparationReason::untimely};
  NearLink near = near_known(settings, link, range_m);
  if (visibility.doubtful_distance_m < near.distance_m) {
    near = with_unknown(near, settings.doubtful, visibility.doubtful_distance_m,
                        SeparationReason::doubtful);
  }
  if (!is_seen_enough(settings, link, visibility)) {
    near =
        with_unknown(near, settings.not_seen, settings.assumed_range_m, SeparationReason::not_seen);
  }
  return near;
}

}  // namespace berth
