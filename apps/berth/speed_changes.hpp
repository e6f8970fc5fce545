#pragma once

#include <optional>

#include "berth/pipeline/result.hpp"

namespace berth::app {

/// Whether the robot may go on, is slowed down or has to stand: told to standard output wherever
/// that changes.
class SpeedChanges {
 public:
  /// Such as "  3.200 s  stop: arm_link_5 is 0.310 m from what a camera sees".
  void take(double time_s, const Result& result);

 private:
  std::optional<SeparationState> before_;
};

}  // namespace berth::app
