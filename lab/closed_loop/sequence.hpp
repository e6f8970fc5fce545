// What berth reports on an arm and people that move, instant by instant, beside the truth.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "berth/space/settings.hpp"
#include "sim/sensor_model.hpp"
#include "sim/true_distance.hpp"

namespace berth::lab {

/// What the cameras do wrong, and how many of cell_cameras() there are.
struct SequenceCondition {
  std::string name;
  sim::SensorErrors image = {};
  SpaceSettings space = {};
  int cameras = 3;
};
std::vector<SequenceCondition> sequence_conditions();

struct SequenceSettings {
  double image_hz = 30;
  /// From one instant that is judged to the next.
  double every_s = 0.2;
};

/// One link that a joint moves, at one instant. Distances of at most the range; the range where
/// nothing is nearer.
struct SequenceLink {
  double true_m = 0;
  /// To what is seen or unknown, and to what is seen.
  double told_m = 0;
  double occupied_m = 0;
  /// How the truth's nearest point shows in the images, by the camera that shows most.
  sim::ObstacleSight sight = sim::ObstacleSight::outside;
};
using SequenceInstant = std::vector<SequenceLink>;

/// An encounter, with four things that stand around the arm and are in no model. The arm goes on at
/// full speed; each camera exposes at times of its own. An instant is an exposure of the first one;
/// the others' images are 11 and 22 ms older then. [i] is of conditions[i]. Depends on its
/// arguments alone.
std::vector<std::vector<SequenceInstant>> run_sequence(
    std::uint32_t seed, const std::vector<SequenceCondition>& conditions,
    const SequenceSettings& settings = {});

/// As Markdown.
std::string sequence_table(const std::vector<SequenceCondition>& conditions,
                           const std::vector<std::vector<SequenceInstant>>& instants);

}  // namespace berth::lab
