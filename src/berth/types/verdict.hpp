#pragma once

#include <array>
#include <cstdint>
#include <string_view>

namespace berth {

/// What is known of a configuration or a motion of the robot.
enum class Verdict : std::uint8_t {
  free,       ///< each moved link is farther than its margin from all that is asked about
  near,       ///< some link is no farther than its margin
  undecided,  ///< neither is shown
};
/// By enumerator.
inline constexpr std::array<std::string_view, 3> kVerdictNames = {"free", "near", "undecided"};
constexpr std::string_view name_of(Verdict verdict) {
  return kVerdictNames[static_cast<std::size_t>(verdict)];
}

}  // namespace berth
