// Where a command computes.
#pragma once

#include <CLI/CLI.hpp>
#include <string>

namespace berth::app {

enum class Backend { cpu, opengl };

struct BackendArguments {
  Backend backend = Backend::cpu;
  /// As GlContext takes it; also for methods that run on OpenGL whatever the backend is.
  std::string gl_device;
};

/// Adds --backend and --gl-device; `what` says what the backend does in this command.
void add_backend_options(CLI::App& command, const std::string& what, BackendArguments& arguments);
/// --gl-device alone.
void add_gl_device(CLI::App& command, BackendArguments& arguments);

}  // namespace berth::app
