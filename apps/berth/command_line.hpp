#pragma once

namespace berth::app {

/// Does what the command line of `berth` asks for. Returns the program's exit status.
int run_command_line(int argc, const char* const* argv);

}  // namespace berth::app
