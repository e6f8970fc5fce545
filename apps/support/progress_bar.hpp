#pragma once

#include <cstddef>
#include <string>

namespace berth::app {

/// A line that reports how far a command is, on standard error; nothing where that is no terminal.
class ProgressBar {
 public:
  /// Shows it at once. 0: how many steps there will be is not known.
  ProgressBar(std::string doing, std::size_t total);
  /// Takes the line away.
  ~ProgressBar();
  ProgressBar(const ProgressBar&) = delete;
  ProgressBar& operator=(const ProgressBar&) = delete;

  void step();
  /// Takes the line away for other output; the next step shows it again.
  void clear() const;

 private:
  std::string doing_;
  std::size_t total_;
  std::size_t done_ = 0;
  bool is_terminal_;

  void show() const;
};

}  // namespace berth::app
