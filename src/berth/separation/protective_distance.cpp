#include "berth/separation/protective_distance.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace berth {
namespace {

void validate_row(const StoppingRow& row, const StoppingRow& before, std::size_t number) {
  const auto check = [&](std::string_view name, double value, double least, bool above) {
    const Domain domain{.least = least, .is_open = above};
    if (domain.holds(value)) return;
    throw_bad_setting(fmt::format("separation.stopping[{}]", number), name, value,
                      domain.text(false));
  };
  check("speed_m_s", row.speed_m_s, before.speed_m_s, true);
  check("time_s", row.time_s, before.time_s, false);
  check("distance_m", row.distance_m, before.distance_m, false);
}

}  // namespace

void validate(const SeparationSettings& settings) {
  visit_settings(settings, SettingCheck{"separation"});
  StoppingRow before;
  for (std::size_t i = 0; i < settings.stopping.size(); ++i) {
    validate_row(settings.stopping[i], before, i);
    before = settings.stopping[i];
  }
}

namespace {

/// 2^-20 of a speed is far below what a robot can be told.
constexpr int kHalvings = 20;

Stopping between(const StoppingRow& low, const StoppingRow& high, double speed_m_s) {
  const double share = (speed_m_s - low.speed_m_s) / (high.speed_m_s - low.speed_m_s);
  return {low.time_s + share * (high.time_s - low.time_s),
          low.distance_m + share * (high.distance_m - low.distance_m)};
}

}  // namespace

Stopping stopping_from(const SeparationSettings& settings, double speed_m_s, double end_m_s) {
  if (speed_m_s <= end_m_s) return {};
  const std::vector<StoppingRow>& rows = settings.stopping;
  if (rows.empty()) {
    const double a = settings.deceleration_m_s2;
    return {(speed_m_s - end_m_s) / a, (speed_m_s * speed_m_s - end_m_s * end_m_s) / (2 * a)};
  }
  const auto above = std::ranges::lower_bound(rows, speed_m_s, {}, &StoppingRow::speed_m_s);
  if (above == rows.end()) {
    constexpr double kInfinity = std::numeric_limits<double>::infinity();
    return {kInfinity, kInfinity};
  }
  // A brake takes time to grip, at any speed.
  if (above == rows.begin()) return {above->time_s, above->distance_m};
  return between(*(above - 1), *above, speed_m_s);
}

double time_to_stop_within_s(const SeparationSettings& settings, double distance_m, double most_m_s,
                             double end_m_s) {
  if (settings.stopping.empty()) {
    const double a = settings.deceleration_m_s2;
    const double within_m_s = std::sqrt(end_m_s * end_m_s + 2 * a * distance_m);
    return std::max(0.0, std::min(within_m_s, most_m_s) - end_m_s) / a;
  }
  double enough_m_s = 0;
  double too_much_m_s = most_m_s;
  for (int i = 0; i < kHalvings; ++i) {
    const double middle = (enough_m_s + too_much_m_s) / 2;
    const bool is_within = stopping_from(settings, middle).distance_m <= distance_m;
    (is_within ? enough_m_s : too_much_m_s) = middle;
  }
  return stopping_from(settings, too_much_m_s).time_s;
}

double intrusion_m(const SeparationSettings& settings, double least_detection_m) {
  if (settings.intrusion_m) return *settings.intrusion_m;
  if (!settings.detection_m) return kUnprovenIntrusion_m;
  constexpr double kGreatestDetection_m = 0.040, kFinger_m = 0.014, kPerDetection = 8;
  const double detection_m = std::max(*settings.detection_m, least_detection_m);
  if (detection_m > kGreatestDetection_m) return kUnprovenIntrusion_m;
  return std::max(0.0, kPerDetection * (detection_m - kFinger_m));
}

double protective_distance_m(const SeparationSettings& settings, const ProtectiveTerms& terms,
                             const LinkSpeed& speed) {
  const Stopping stopping = stopping_from(settings, speed.robot_m_s, terms.contact_m_s);
  if (std::isinf(stopping.distance_m)) return stopping.distance_m;
  const double person_m = settings.human_speed_m_s * (terms.reaction_time_s + stopping.time_s);
  const double share = speed.robot_m_s > 0 ? speed.link_m_s / speed.robot_m_s : 1;
  const double robot_m = speed.link_m_s * terms.reaction_time_s + share * stopping.distance_m;
  return person_m + robot_m + intrusion_m(settings, terms.least_detection_m) +
         terms.camera_uncertainty_m + settings.robot_uncertainty_m;
}

double greatest_speed_scale(const SeparationSettings& settings, const ProtectiveTerms& terms,
                            const LinkSpeed& speed, double distance_m, double most) {
  const auto has_room = [&](double scale) {
    return protective_distance_m(settings, terms,
                                 {scale * speed.link_m_s, scale * speed.robot_m_s}) <= distance_m;
  };
  if (has_room(most)) return most;
  if (!has_room(0)) return 0;
  double enough = 0;
  double too_much = most;
  for (int i = 0; i < kHalvings; ++i) {
    const double middle = (enough + too_much) / 2;
    (has_room(middle) ? enough : too_much) = middle;
  }
  return enough;
}

namespace {

double told_m(const MountedCamera& camera) {
  return detection_capability_m(camera.settings().space, camera.camera());
}

}  // namespace

double least_detection_m(std::span<const CameraResult> cameras) {
  double least_m = 0;
  for (const CameraResult& camera : cameras) {
    if (!camera.mounted || !is_used(camera.status)) continue;
    least_m = std::max(least_m, told_m(*camera.mounted));
  }
  return least_m;
}

std::string detection_trouble(const SeparationSettings& settings, const MountedCamera& camera) {
  if (settings.intrusion_m || !settings.detection_m) return {};
  const double least_m = told_m(camera);
  if (least_m <= *settings.detection_m) return {};
  return fmt::format(
      "separation.detection_m: {}; expected at least space.detection_capability_m of camera "
      "\"{}\", {}: what is smaller may hide from it. C is {:.3f} m",
      *settings.detection_m, camera.mount().name, least_m, intrusion_m(settings, least_m));
}

}  // namespace berth
