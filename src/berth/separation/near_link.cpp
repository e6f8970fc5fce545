#include "berth/separation/near_link.hpp"

#include <algorithm>
#include <cmath>

namespace berth {
namespace {

SeparationReason reason_of(const LinkResult& link) {
  switch (link.status) {
    case LinkStatus::none_in_range:
      return SeparationReason::range;
    case LinkStatus::cut_short:
      return SeparationReason::cut_short;
    default:
      break;
  }
  if (!link.has_distance()) return SeparationReason::range;
  switch (link.obstacle_is) {
    case ObstacleKind::unknown:
      return SeparationReason::unknown;
    case ObstacleKind::unobserved:
      return SeparationReason::unobserved;
    default:
      return SeparationReason::occupied;
  }
}

/// To what is seen alone.
NearLink near_reading(const LinkResult& link) {
  return {link.occupied.lower_bound_m,
          link.occupied.is_known() ? SeparationReason::occupied : SeparationReason::range};
}

/// By what is certified.
NearLink near_known(const SeparationSettings& settings, const LinkResult& link, double range_m) {
  if (std::isnan(link.lower_bound_m)) return {range_m, SeparationReason::range};
  const NearLink known{link.lower_bound_m, reason_of(link)};
  const bool is_unknown =
      known.reason == SeparationReason::unknown || known.reason == SeparationReason::unobserved;
  if (!is_unknown) return known;
  if (settings.unknown == UnknownPolicy::ignore) return near_reading(link);
  return with_unknown(known, settings.unknown, known.distance_m, known.reason);
}

bool is_seen_enough(const SeparationSettings& settings, const LinkResult& link) {
  if (link.status == LinkStatus::not_seen || link.status == LinkStatus::not_visible) return false;
  return !link.visibility.surface.is_known() || link.visibility.surface.seen >= settings.least_seen;
}

}  // namespace

NearLink with_unknown(const NearLink& near, UnknownPolicy policy, double distance_m,
                      SeparationReason reason) {
  if (policy == UnknownPolicy::ignore) return near;
  if (policy == UnknownPolicy::stop) return {0, reason};
  return distance_m < near.distance_m ? NearLink{distance_m, reason} : near;
}

NearLink near_link(const SeparationSettings& settings, const LinkResult& link, double range_m) {
  if (link.status == LinkStatus::stale) return {0, SeparationReason::stale};
  NearLink near = near_known(settings, link, range_m);
  if (link.visibility.rejected_distance_m < near.distance_m) {
    near = with_unknown(near, settings.rejected, link.visibility.rejected_distance_m,
                        SeparationReason::rejected);
  }
  if (link.status == LinkStatus::not_observed) {
    near = with_unknown(near, settings.unknown, settings.assumed_range_m,
                        SeparationReason::unobserved);
  }
  if (!is_seen_enough(settings, link)) {
    near =
        with_unknown(near, settings.not_seen, settings.assumed_range_m, SeparationReason::not_seen);
  }
  return near;
}

double camera_uncertainty_m(const CameraSettings& settings, LinkId link, double depth_m) {
  const SelfFilterSettings& filter = settings.self_filter;
  const double z_m = std::max(0.0, depth_m);
  const double tolerance_m = filter.tolerance_m + filter.tolerance_per_m2 * z_m * z_m;
  return std::max(tolerance_m, filter.padding_of(link)) +
         settings.sensor.noise_m * std::max(1.0, z_m * z_m);
}

}  // namespace berth
