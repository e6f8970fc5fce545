#pragma once

#include <stop_token>
#include <string>

namespace berth::app {

/// Thrown where a command was asked to stop by SIGINT or SIGTERM.
struct Interrupted {
  /// Such as "after 12 of 500 images", for people; empty where nothing is to be said.
  std::string done = {};
};

/// From now on these signals are noted instead of ending the program, so that no file is left
/// half-written. A second one ends it.
void note_interrupts();

/// Throws Interrupted if one came.
void stop_if_interrupted();

/// Asked to stop soon after one came, for what runs long. From the first call on a thread looks for
/// that.
std::stop_token interruption();

}  // namespace berth::app
