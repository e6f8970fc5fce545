#include "apps/berth/picture_palette.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>

namespace berth::app {
namespace {

// Okabe and Ito (2008), then five that stay apart from these and from one another in all kinds of
// sight, in an order that keeps neighbours of a chain furthest apart.
constexpr std::array<Rgb, 12> kLinkHues{{{0xE6, 0x9F, 0x00},
                                         {0x00, 0x72, 0xB2},
                                         {0xF0, 0xE4, 0x42},
                                         {0xD5, 0x5E, 0x00},
                                         {0x56, 0xB4, 0xE9},
                                         {0xCC, 0x79, 0xA7},
                                         {0x00, 0x9E, 0x73},
                                         {0xAA, 0x33, 0x77},
                                         {0xB9, 0xAC, 0x70},
                                         {0x4B, 0x3B, 0xB5},
                                         {0x8C, 0x5A, 0x2B},
                                         {0xB8, 0xE6, 0xD0}}};

}  // namespace

std::string css(Rgb color) { return fmt::format("#{:02x}{:02x}{:02x}", color.r, color.g, color.b); }

Rgb mix(Rgb a, Rgb b, double share) {
  const auto blend = [share](std::uint8_t x, std::uint8_t y) {
    return static_cast<std::uint8_t>(std::lround(x + share * (y - x)));
  };
  return {blend(a.r, b.r), blend(a.g, b.g), blend(a.b, b.b)};
}

Rgb link_color(LinkId id) {
  const std::size_t index = id - 1;
  const Rgb hue = kLinkHues[index % kLinkHues.size()];
  switch (index / kLinkHues.size() % 3) {
    case 1:
      return mix(hue, kWhite, 0.45);
    case 2:
      return mix(hue, kBlack, 0.28);
    default:
      return hue;
  }
}

Rgb fate_color(PixelFate fate) {
  switch (fate) {
    case PixelFate::obstacle:
      return {0xA8, 0xA8, 0xA8};
    case PixelFate::no_reading:
      return {0x12, 0x13, 0x16};
    case PixelFate::robot:
      return {0x3E, 0x6F, 0xB0};
    case PixelFate::padding:
      return {0x8E, 0x5F, 0xB8};
    case PixelFate::environment:
      return {0x8A, 0x6A, 0x3C};
    case PixelFate::flying_patch:
      return {0x6C, 0xA8, 0x3C};
    case PixelFate::outside_region:
      return {0xB8, 0xA4, 0x3A};
    case PixelFate::soft:
      return {0xD8, 0x7A, 0x4A};
    case PixelFate::speckle:
      return {0xE0, 0xB0, 0x20};
    case PixelFate::background:
      return {0x20, 0xB8, 0x70};
    case PixelFate::hole:
      return {0xE0, 0x60, 0xC0};
  }
  return kBlack;
}

}  // namespace berth::app
