#pragma once

#include "sim/random_images.hpp"

namespace berth::testing {

/// Smooth surfaces that lie equally far from each other everywhere, so that all pairs of tiles tie.
/// The robot's links stand side by side as columns.

/// A plate before a parallel plane 0.3 m behind it, both tilted about the image's vertical axis.
sim::ImagePair tilted_plates(double tilt_rad, int width, int height);

/// The near side of a ball, and the far side of a bowl, in a shell 0.15 m away.
sim::ImagePair ball_in_shell(int width, int height);
sim::ImagePair bowl_in_shell(int width, int height);

}  // namespace berth::testing
