#include "apps/berth/residual_colors.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace berth::app {
namespace {

constexpr int kParts = 3;
constexpr std::array<double, kParts + 1> kStops_m = {0, 0.01, 0.03, kResidualScale_m};
constexpr Rgb kFits{0xF7, 0xF7, 0xF7};
constexpr std::array<Rgb, kParts + 1> kNearer = {
    {kFits, {0xFD, 0xC0, 0x6F}, {0xE0, 0x66, 0x08}, {0x7A, 0x2A, 0x04}}};
constexpr std::array<Rgb, kParts + 1> kFarther = {
    {kFits, {0x8E, 0xC4, 0xE8}, {0x2B, 0x74, 0xBE}, {0x0A, 0x2C, 0x66}}};

}  // namespace

double scale_place(double residual_m) {
  const double length_m = std::min(std::abs(residual_m), kResidualScale_m);
  int part = 0;
  while (part + 2 < static_cast<int>(kStops_m.size()) && length_m > kStops_m[part + 1]) ++part;
  const double place =
      (part + (length_m - kStops_m[part]) / (kStops_m[part + 1] - kStops_m[part])) / kParts;
  return std::copysign(place, residual_m);
}

double residual_at(double place) {
  const double steps = std::min(std::abs(place), 1.0) * kParts;
  const int part = std::min(static_cast<int>(steps), kParts - 1);
  return std::copysign(std::lerp(kStops_m[part], kStops_m[part + 1], steps - part), place);
}

Rgb residual_color(double residual_m) {
  const double steps = std::abs(scale_place(residual_m)) * kParts;
  const int part = std::min(static_cast<int>(steps), kParts - 1);
  const auto& hues = residual_m < 0 ? kNearer : kFarther;
  return mix(hues[part], hues[part + 1], steps - part);
}

std::vector<ResidualColor> residual_scale() {
  std::vector<ResidualColor> scale;
  for (int part = -kParts; part <= kParts; ++part) {
    const double residual_m = std::copysign(kStops_m[std::abs(part)], part);
    scale.push_back({residual_m, residual_color(residual_m)});
  }
  return scale;
}

Stripes beyond_scale(double residual_m) {
  const auto& hues = residual_m < 0 ? kNearer : kFarther;
  return {hues[kParts], hues[1]};
}

}  // namespace berth::app
