#include "apps/support/program.hpp"

#include <fmt/format.h>
#include <tbb/global_control.h>
#include <CLI/CLI.hpp>

#include <cstdio>
#include <exception>

#include "apps/support/interrupt.hpp"

namespace berth::app {
namespace {

constexpr int kDone = 0;
constexpr int kCouldNot = 1;
constexpr int kWrongUsage = 2;
constexpr int kInterrupted = 130;

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

int carry_out(const char* program_name, int threads, const std::function<void()>& work) {
  std::optional<tbb::global_control> limit;
  if (threads > 0) limit.emplace(tbb::global_control::max_allowed_parallelism, threads);
  note_interrupts();
  try {
    work();
    return kDone;
  } catch (const Interrupted&) {
    fmt::print(stderr, "{}: interrupted\n", program_name);
    return kInterrupted;
  } catch (const std::exception& error) {
    fmt::print(stderr, "{}: {}\n", program_name, error.what());
    return kCouldNot;
  }
}

}  // namespace berth::app
