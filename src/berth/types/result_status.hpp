#pragma once

#include <array>
#include <cstdint>
#include <string_view>

namespace berth {

enum class LinkStatus : std::uint8_t {
  ok,             ///< there is a distance
  none_in_range,  ///< the link is seen, and nothing is within the range
  not_visible,    ///< the thesis: the camera sees no pixel of the link, so nothing is known
  cut_short,      ///< the search was stopped before it found a pair within the range
  stale,          ///< stamps or ages allow no answer (Result::time): nothing is known
  not_seen,       ///< hardly anything of the link is seen by any camera. What is known
                  ///< to be near stands beside it, but nothing is promised
  not_observed,   ///< too much of the space within its distance, or the range, lies in
                  ///< no image. What is known to be near stands beside it, but nothing is promised
};
/// By enumerator.
inline constexpr std::array<std::string_view, 7> kLinkStatusNames = {
    "ok", "none_in_range", "not_visible", "cut_short", "stale", "not_seen", "not_observed"};

constexpr std::string_view name_of(LinkStatus status) {
  return kLinkStatusNames[static_cast<std::size_t>(status)];
}

/// How good a whole result is.
enum class ResultStatus : std::uint8_t {
  ok,        ///< every camera is in it
  degraded,  ///< a camera is not in it, or not relied on: distances may be larger than with it
  stale,     ///< stamps, ages or a camera allow no answer: no link has a distance
};
/// By enumerator.
inline constexpr std::array<std::string_view, 3> kResultStatusNames = {"ok", "degraded", "stale"};

constexpr std::string_view name_of(ResultStatus status) {
  return kResultStatusNames[static_cast<std::size_t>(status)];
}

}  // namespace berth
