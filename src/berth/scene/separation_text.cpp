#include "berth/scene/separation_text.hpp"

#include <fmt/format.h>

#include <cmath>

namespace berth {
namespace {

std::string near_text(const FrameResult& result, const LinkSeparation& link,
                      std::string_view what) {
  return fmt::format("{} is {:.3f} m from {}; at {:.2f} m/s it needs {:.3f} m",
                     result.link_names[link.id - 1], std::floor(1e3 * link.distance_m) / 1e3, what,
                     link.speed_m_s, link.required_m);
}

std::string seen_text_of(const FrameResult& result, LinkId id) {
  const std::string& name = result.link_names[id - 1];
  if (!result.visibility || !(*result.visibility)[id - 1].surface.is_known()) {
    return name + " is not seen";
  }
  const float unseen = 1 - (*result.visibility)[id - 1].surface.seen;
  return fmt::format("{} is {:.0f} % unseen", name, 100 * unseen);
}

std::string camera_text(const FrameResult& result, int camera) {
  const CameraResult& lost = result.cameras[camera];
  return fmt::format("camera {} cannot be relied on ({})", lost.name, name_of(lost.state.status));
}

std::string why(const FrameResult& result) {
  const Separation& separation = *result.separation;
  const auto near = [&](std::string_view what) {
    return near_text(result, separation.links[separation.link - 1], what);
  };
  switch (separation.reason) {
    case SeparationReason::none:
      return "";
    case SeparationReason::reading:
      return near("what a camera sees");
    case SeparationReason::hidden:
      return near("space that no camera sees");
    case SeparationReason::doubtful:
      return near("a reading that was dropped as doubtful");
    case SeparationReason::range:
      return near("the end of the range");
    case SeparationReason::cut_short:
      return near("where the deadline cut the search");
    case SeparationReason::not_seen:
      return seen_text_of(result, separation.link);
    case SeparationReason::camera:
      return camera_text(result, separation.camera);
    case SeparationReason::untimely:
      return "there is no answer in time";
    case SeparationReason::velocity:
      return "the robot's velocity is not known";
    case SeparationReason::hold:
      return "there has not been room for long enough";
  }
  return "";
}

}  // namespace

std::string separation_text(const FrameResult& result) {
  const Separation& separation = *result.separation;
  std::string text(name_of(separation.state));
  if (separation.state == SeparationState::reduced) {
    text += fmt::format(" to {:.0f} %", std::floor(100 * separation.speed_scale));
  }
  const std::string reason = why(result);
  return reason.empty() ? text : text + ": " + reason;
}

}  // namespace berth
