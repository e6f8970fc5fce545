// Images that are hard for a search: drawn by formula, 8 links, about 25 000 robot pixels at
// 640 x 480.
#pragma once

#include <cstdint>

#include "sim/random_images.hpp"

namespace berth::lab {

/// A random scene in which each link touches an obstacle: distance 0.
sim::ImagePair contact_images(std::uint32_t seed, int width, int height);
/// A random robot before readings between 0.4 and 3 m without any order.
sim::ImagePair noise_images(std::uint32_t seed, int width, int height);
/// Robot and obstacle by turns, in squares of cell_px pixels, the obstacle about 0.2 m deeper.
sim::ImagePair checkerboard_images(int cell_px, int width, int height);
/// A plate before a plane 0.3 m behind it, both turned by tilt_rad around the vertical: all pairs
/// of feet tie. The plane is known behind the plate, too.
sim::ImagePair plate_images(double tilt_rad, int width, int height);
/// A ball around (0, 0, 1.5 m) inside a shell gap_m larger, of which the camera sees the far side:
/// all pairs along the ball's outline tie.
sim::ImagePair ball_images(double gap_m, int width, int height);

}  // namespace berth::lab
