#include "apps/support/threads_argument.hpp"

#include <CLI/CLI.hpp>

namespace berth::app {

void add_threads(CLI::App& command, int& threads) {
  command.add_option("--threads", threads, "Threads to use (default: one for each processor)")
      ->check(CLI::Range(1, 1024))
      ->type_name("N");
}

}  // namespace berth::app
