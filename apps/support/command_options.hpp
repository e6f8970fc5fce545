// The command line, and the options that programs share.
#pragma once

#include <functional>
#include <optional>
#include <string>

#include "thesis/backend.hpp"

namespace CLI {
class App;
}

namespace berth::app {

/// Reads the command line. Where the program is to end right now, the exit status: 0 after --help
/// and --version, 2 where the usage is wrong, which is said on standard error.
/// `check` may throw CLI::ParseError as well.
std::optional<int> parse_command_line(
    CLI::App& program, int argc, const char* const* argv,
    const std::function<void()>& check = [] {});

/// Adds --threads, for every command that works on several of them; 0 where it is not given.
void add_threads(CLI::App& command, int& threads);

/// Adds --backend and --gl-device; `what` says what the backend does in this command.
void add_backend_options(CLI::App& command, const std::string& what, BackendChoice& arguments);
/// --gl-device alone.
void add_gl_device(CLI::App& command, BackendChoice& arguments);

}  // namespace berth::app
