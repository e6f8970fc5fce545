#include "apps/support/progress_bar.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <cstdio>

namespace berth::app {
namespace {

constexpr std::size_t kWidth = 32;

}  // namespace

ProgressBar::ProgressBar(std::string doing, std::size_t total)
    : doing_(std::move(doing)), total_(total), is_terminal_(isatty(STDERR_FILENO) != 0) {
  show();
}

ProgressBar::~ProgressBar() { clear(); }

void ProgressBar::step() {
  ++done_;
  show();
}

void ProgressBar::show() const {
  if (!is_terminal_) return;
  if (total_ == 0) {
    fmt::print(stderr, "\r{}: step {}", doing_, done_);
    std::fflush(stderr);
    return;
  }
  const std::size_t filled = kWidth * done_ / total_;
  fmt::print(stderr, "\r{} [{:=<{}}{: <{}}] {}/{}", doing_, "", filled, "", kWidth - filled, done_,
             total_);
  std::fflush(stderr);
}

void ProgressBar::clear() const {
  if (is_terminal_) fmt::print(stderr, "\r\033[K");
}

}  // namespace berth::app
