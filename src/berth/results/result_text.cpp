#include "berth/results/result_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "berth/results/link_table.hpp"

namespace berth {
namespace {

/// Within 1 mm, unless a deadline cut the search, the distance says enough without its bound.
constexpr float kTellBound_m = 0.0015F;

std::string sure_distance_text(const LinkResult& link) {
  const bool is_sure = link.has_distance() && link.distance_m - link.lower_bound_m < kTellBound_m;
  const bool is_none = link.status == LinkStatus::none_in_range;
  return distance_text(link, !is_sure && !is_none && link.status != LinkStatus::stale);
}

LinkTable::Cells cells_of(const LinkResult& link, const Result& result) {
  const bool known = link.has_distance();
  const std::string occupied =
      link.occupied.is_known() ? fmt::format("{:.4f}", link.occupied.distance_m) : "-";
  return {sure_distance_text(link), known ? std::string(name_of(link.obstacle_is)) : "-", occupied,
          known ? std::string(result.camera_of(link)) : "-",
          known ? pixel_text(link.obstacle_pixel) : "-"};
}

/// Such as "0.1370 table".
std::string known_text(const LinkResult& link, const Result& result) {
  if (!link.known.is_known()) return "-";
  return fmt::format("{:.4f} {}", link.known.distance_m, result.known_link_of(link.known));
}

std::string seen_text(const LinkVisibility& link) {
  return link.surface.is_known() ? fmt::format("{:.0f} %", 100 * link.surface.seen) : "-";
}

bool has_rejected(const LinkVisibility& link) { return !std::isnan(link.rejected_distance_m); }

std::string rejected_text(const LinkVisibility& link) {
  return has_rejected(link) ? fmt::format("{:.4f}", link.rejected_distance_m) : "-";
}

/// The room that a link needs, and the share of the robot's speed that it allows; cut, not rounded.
void add_separation(const LinkSeparation& link, LinkTable::Cells& cells) {
  const bool is_known = !std::isnan(link.required_m);
  cells.push_back(is_known ? fmt::format("{:.3f}", link.required_m) : "-");
  cells.push_back(link.is_moved ? fmt::format("{:.0f} %", std::floor(100 * link.speed_scale))
                                : "-");
}

}  // namespace

std::string result_table(const Result& result) {
  LinkTable::Cells heading = {"distance [m]", "nearest is", "to occupied [m]", "camera",
                              "obstacle pixel"};
  if (result.link_names) heading.push_back("to known [m]");
  if (result.has_visibility) heading.push_back("seen");
  const bool has_any_rejected =
      std::ranges::any_of(result.links, has_rejected, &LinkResult::visibility);
  if (has_any_rejected) heading.push_back("rejected [m]");
  if (result.separation) heading.insert(heading.end(), {"needs [m]", "may go"});
  LinkTable table(heading);
  for (const std::size_t i : moved_first(result)) {
    const LinkResult& link = result.links[i];
    LinkTable::Cells cells = cells_of(link, result);
    if (result.link_names) cells.push_back(known_text(link, result));
    if (result.has_visibility) cells.push_back(seen_text(link.visibility));
    if (has_any_rejected) cells.push_back(rejected_text(link.visibility));
    if (result.separation) add_separation(result.separation->links[i], cells);
    table.add(link, cells);
  }
  return table.text();
}

namespace {

/// " (0.42 s)" where a length of time is known.
std::string in_brackets(double seconds) {
  return std::isnan(seconds) ? std::string() : fmt::format(" ({:.2f} s)", seconds);
}

std::string stale_text(const Timeliness& time) {
  switch (time.status) {
    case TimeStatus::ok:
      return "";
    case TimeStatus::no_joints:
      return "no complete joint state has come yet";
    case TimeStatus::missing_joint:
      return "the newest joint states lack a joint of the robot";
    case TimeStatus::extrapolated_too_far:
      return "the exposure lies outside of the joint states" + in_brackets(time.skew_s);
    case TimeStatus::skewed:
      return "no joint state lies near enough to the exposure" + in_brackets(time.skew_s);
    case TimeStatus::stamp_went_back:
      return "an image's stamp is not above that of the one before";
    case TimeStatus::stamp_jumped:
      return "an image's stamp is too far above that of the one before";
    case TimeStatus::frame_in_future:
      return fmt::format("an image's stamp lies {:.3f} s in the future", -time.frame_age_s);
    case TimeStatus::stale_frame:
      return fmt::format("the newest image is {:.3f} s old", time.frame_age_s);
    case TimeStatus::stale_joints:
      if (time.joints_age_s < 0) {
        return fmt::format("the joint states lie {:.3f} s in the future", -time.joints_age_s);
      }
      return fmt::format("the joint states are {:.3f} s old", time.joints_age_s);
    case TimeStatus::no_frame:
      return "no camera has given an image yet";
    case TimeStatus::camera_moved:
      return "no camera stands where it should";
    case TimeStatus::camera_implausible:
      return "the robot is not where it should be in the images";
    case TimeStatus::stale_pose:
      return "nobody tells where the camera stood at the exposure";
  }
  return "";
}

}  // namespace

std::string camera_text(const CameraResult& camera) {
  if (is_relied_on(camera.status)) return "";
  std::string text = fmt::format("camera {} is {}", camera.camera, name_of(camera.status));
  if (camera.status == CameraStatus::too_old) return text + in_brackets(camera.age_s);
  if (camera.status == CameraStatus::stale) text += fmt::format(" ({})", name_of(camera.time));
  return text;
}

std::string status_text(const Result& result) {
  std::string text(name_of(result.status));
  if (result.status == ResultStatus::stale) return text + ": " + stale_text(result.time);
  const char* before = ": ";
  for (const CameraResult& camera : result.cameras) {
    const std::string lost = camera_text(camera);
    if (lost.empty()) continue;
    text += before + lost;
    before = ", ";
  }
  return text;
}

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
