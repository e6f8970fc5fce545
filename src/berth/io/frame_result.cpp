#include "berth/io/frame_result.hpp"

namespace berth {

const char* status_name(LinkStatus status) {
  constexpr std::array<const char*, 5> kNames = {"ok", "none_in_range", "not_visible", "cut_short",
                                                 "untimely"};
  return kNames.at(static_cast<std::size_t>(status));
}

const char* status_name(TimeStatus status) {
  constexpr std::array<const char*, kTimeStatusCount> kNames = {
      "ok",          "no_joints",       "missing_joint", "extrapolated_too_far",
      "skewed",      "stamp_went_back", "stamp_jumped",  "frame_in_future",
      "stale_frame", "stale_joints"};
  return kNames.at(static_cast<std::size_t>(status));
}

const char* fate_name(PixelFate fate) {
  constexpr std::array<const char*, kPixelFateCount> kNames = {
      "obstacle", "no_reading",     "robot",   "environment", "padding",    "dilation", "edge",
      "island",   "outside_region", "speckle", "averaged",    "background", "hole"};
  return kNames.at(static_cast<std::size_t>(fate));
}

}  // namespace berth
