#include "apps/support/program.hpp"

#include <fmt/format.h>
#include <tbb/global_control.h>

#include <cstdio>
#include <exception>
#include <optional>
#include <string>

#include "apps/support/interrupt.hpp"

namespace berth::app {
namespace {

constexpr int kDone = 0;
constexpr int kCouldNot = 1;
constexpr int kInterrupted = 130;

}  // namespace

int carry_out(const char* program_name, int threads, const std::function<void()>& work) {
  std::optional<tbb::global_control> limit;
  if (threads > 0) limit.emplace(tbb::global_control::max_allowed_parallelism, threads);
  note_interrupts();
  try {
    work();
    return kDone;
  } catch (const Interrupted& interrupted) {
    const std::string& done = interrupted.done;
    fmt::print(stderr, "{}: interrupted{}{}\n", program_name, done.empty() ? "" : " ", done);
    return kInterrupted;
  } catch (const std::exception& error) {
    fmt::print(stderr, "{}: {}\n", program_name, error.what());
    return kCouldNot;
  }
}

}  // namespace berth::app
