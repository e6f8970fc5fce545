#include "apps/support/command_options.hpp"

#include <CLI/CLI.hpp>

namespace berth::app {
namespace {

constexpr int kDone = 0;
constexpr int kWrongUsage = 2;

}  // namespace

std::optional<int> parse_command_line(CLI::App& program, int argc, const char* const* argv,
                                      const std::function<void()>& check) {
  program.failure_message(CLI::FailureMessage::simple);
  try {
    program.parse(argc, argv);
    check();
    return std::nullopt;
  } catch (const CLI::ParseError& error) {
    const bool asked_for_text = error.get_exit_code() == kDone;
    program.exit(error);
    return asked_for_text ? kDone : kWrongUsage;
  }
}

void add_threads(CLI::App& command, int& threads) {
  command.add_option("--threads", threads, "Threads to use (default: one for each processor)")
      ->check(CLI::Range(1, 1024))
      ->type_name("N");
}

void add_gl_device(CLI::App& command, BackendChoice& arguments) {
  command
      .add_option("--gl-device", arguments.gl_device,
                  "For OpenGL: number of the device, or a part of its name (default: the first, "
                  "hardware before software)")
      ->type_name("NAME");
}

void add_backend_options(CLI::App& command, const std::string& what, BackendChoice& arguments) {
  command
      .add_option_function<std::string>(
          "--backend",
          [&arguments](const std::string& name) {
            arguments.backend = name == "opengl" ? Backend::opengl : Backend::cpu;
          },
          what + " (default: cpu)")
      ->check(CLI::IsMember({"cpu", "opengl"}));
  add_gl_device(command, arguments);
}

}  // namespace berth::app
