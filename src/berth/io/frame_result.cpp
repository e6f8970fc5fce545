#include "berth/io/frame_result.hpp"

namespace berth {

const char* status_name(LinkStatus status) {
  constexpr std::array<const char*, 4> kNames = {"ok", "none_in_range", "not_visible", "cut_short"};
  return kNames.at(static_cast<std::size_t>(status));
}

const char* fate_name(PixelFate fate) {
  constexpr std::array<const char*, kPixelFateCount> kNames = {
      "obstacle", "no_reading", "robot",  "environment",   "padding",
      "dilation", "edge",       "island", "outside_region"};
  return kNames.at(static_cast<std::size_t>(fate));
}

}  // namespace berth
