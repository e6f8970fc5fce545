// The colours of reading - model, for pictures, legend and histogram alike.
#pragma once

#include <vector>

#include "apps/berth/picture_palette.hpp"

namespace berth::app {

/// Readings nearer than the model are orange, those farther away blue; white fits. Both stay apart
/// for the colour-blind, and the farther from 0 the darker they are.
Rgb residual_color(double residual_m);

/// The scale from its nearest end to its farthest: between neighbours residual_color() is linear.
struct ResidualColor {
  double residual_m;
  Rgb color;
};
std::vector<ResidualColor> residual_scale();

/// What lies beyond the scale is striped in two colours.
inline constexpr double kResidualScale_m = 0.1;
struct Stripes {
  Rgb dark;
  Rgb light;
};
/// Of a reading that lies farther before (negative) or behind the model.
Stripes beyond_scale(double residual_m);

/// Where a residual stands on the scale, -1 to 1. The scale is finer around 0: 10 mm are a third
/// of it, 30 mm two.
double scale_place(double residual_m);
/// The residual at a place of the scale.
double residual_at(double place);

}  // namespace berth::app
