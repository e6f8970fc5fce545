#include "apps/support/backend_arguments.hpp"

#include <CLI/CLI.hpp>

namespace berth::app {

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
