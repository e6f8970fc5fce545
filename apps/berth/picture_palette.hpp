// The colours of the picture.
#pragma once

#include <cstdint>
#include <string>

#include "berth/types/obstacle_image.hpp"
#include "berth/types/robot_image.hpp"

namespace berth::app {

/// sRGB, 0 to 255.
struct Rgb {
  std::uint8_t r = 0;
  std::uint8_t g = 0;
  std::uint8_t b = 0;
  bool operator==(const Rgb&) const = default;
};

inline constexpr Rgb kBlack{0, 0, 0};
inline constexpr Rgb kWhite{255, 255, 255};

/// Such as "#0072b2".
std::string css(Rgb color);

/// From a (share 0) to b (share 1).
Rgb mix(Rgb a, Rgb b, double share);

/// Twelve hues that stay apart for the colour-blind, then the same ones light, then dark, and so
/// on.
Rgb link_color(LinkId id);

/// The tint of a pixel that was filtered out or that a sensor rule changed; obstacle and no_reading
/// have the grey that the legend shows.
Rgb fate_color(PixelFate fate);

}  // namespace berth::app
