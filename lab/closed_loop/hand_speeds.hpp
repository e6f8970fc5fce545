#pragma once

#include <span>
#include <string>
#include <vector>

#include "sim/bvh.hpp"

namespace berth::lab {

/// While a hand is faster than some speed.
struct Burst {
  double way_m = 0;
  /// Beyond the way that it makes at that speed in the same time.
  double beyond_m = 0;
};

/// Of each hand's middle, from each frame but the first and the last one, over two frames.
std::vector<std::vector<double>> hand_speeds_m_s(const sim::Bvh& motion);

std::vector<Burst> bursts_above(double m_s, const std::vector<double>& speeds_m_s, double frame_s);

/// A Markdown table: how fast hands are, for each motion and for all of them.
std::string hand_speed_table(std::span<const sim::Bvh> motions);

}  // namespace berth::lab
