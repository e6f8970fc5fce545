// What each program does around its work: the command line, and how it ends.
#pragma once

#include <functional>
#include <optional>

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

/// Does the work with so many threads (0: as many as there are processors), and gives the exit
/// status: 0, 1 where it could not be done, 130 where the user stopped it; both are said on
/// standard error, with the program's name.
int carry_out(const char* program_name, int threads, const std::function<void()>& work);

}  // namespace berth::app
