// Where a command computes.
#pragma once

#include <string>

#include "berth/scene/backend.hpp"

namespace CLI {
class App;
}

namespace berth::app {

/// Adds --backend and --gl-device; `what` says what the backend does in this command.
void add_backend_options(CLI::App& command, const std::string& what, BackendChoice& arguments);
/// --gl-device alone.
void add_gl_device(CLI::App& command, BackendChoice& arguments);

}  // namespace berth::app
