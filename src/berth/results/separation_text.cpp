#include "berth/results/result_text.hpp"

#include <fmt/format.h>

#include <cmath>

namespace berth {
namespace {

std::string near_text(const Result& result, const LinkSeparation& link, std::string_view what) {
  return fmt::format("{} is {:.3f} m from {}; at {:.2f} m/s it needs {:.3f} m",
                     result.links[link.id - 1].link, std::floor(1e3 * link.distance_m) / 1e3, what,
                     link.speed_m_s, link.required_m);
}

std::string seen_text_of(const Result& result, LinkId id) {
  const LinkResult& link = result.links[id - 1];
  if (!link.visibility.surface.is_known()) return link.link + " is not seen";
  return fmt::format("{} is {:.0f} % unseen", link.link, 100 * (1 - link.visibility.surface.seen));
}

std::string why(const Result& result) {
  const Separation& separation = *result.separation;
  const auto near = [&](std::string_view what) {
    return near_text(result, separation.links[separation.link - 1], what);
  };
  switch (separation.reason) {
    case SeparationReason::none:
      return "";
    case SeparationReason::occupied:
      return near("what a camera sees");
    case SeparationReason::unknown:
      return near("space that no camera sees");
    case SeparationReason::unobserved:
      return near("space that is in no image");
    case SeparationReason::rejected:
      return near("a reading that was dropped as rejected");
    case SeparationReason::range:
      return near("the end of the range");
    case SeparationReason::cut_short:
      return near("where the deadline cut the search");
    case SeparationReason::not_seen:
      return seen_text_of(result, separation.link);
    case SeparationReason::camera:
      return camera_text(result.cameras[separation.camera]);
    case SeparationReason::no_reading:
      return fmt::format(
          "camera {} does not tell what gives no reading, such as black clothes "
          "(separation.no_reading)",
          result.cameras[separation.camera].camera);
    case SeparationReason::stale:
      return status_text(result);
    case SeparationReason::velocity:
      return "the robot's velocity is not known";
    case SeparationReason::speeding_up:
      return "there is room, and the robot gains speed";
  }
  return "";
}

}  // namespace

std::string separation_text(const Result& result) {
  const Separation& separation = *result.separation;
  const double percent = std::floor(100 * separation.speed_scale);
  std::string text(name_of(separation.state));
  if (separation.state == SeparationState::reduced) text += fmt::format(" to {:.0f} %", percent);
  if (separation.state == SeparationState::contact_speed) {
    text = fmt::format("reduced to {:.0f} %, the speed of a tolerable contact", percent);
  }
  const std::string reason = why(result);
  return reason.empty() ? text : text + ": " + reason;
}

}  // namespace berth
