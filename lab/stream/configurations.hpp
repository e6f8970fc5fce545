// Many configurations of one image, for berth_bench.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "berth/robot/robot_model.hpp"
#include "lab/stream/stream.hpp"
#include "sim/random.hpp"

namespace berth::lab {

struct ConfigurationSettings {
  /// Configurations of the whole workspace.
  std::size_t count = 100'000;
  double margin_m = 0.03;
};

/// From all over the joints' limits, no joint turned by more than half a turn; one configuration
/// after another.
std::vector<double> draw_configurations(const RobotModel& model, std::size_t count,
                                        sim::Random& random);

/// How quickly one core says of configurations whether they are free in images of one time of
/// what `stream` names, how quickly Request::ahead does, whether both agree, and in what part of
/// the exact search's time resolve decides the rest. Returns lines or one JSON object. Throws as
/// run_stream does.
std::string run_configurations(const StreamSettings& stream, const ConfigurationSettings& settings);

}  // namespace berth::lab
