// The berth program as a child process, so that its tests see what a user sees.
#pragma once

#include <sys/types.h>

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include "tests/support/temporary_folder.hpp"

namespace berth {

struct Outcome {
  /// 128 + the signal where a signal ended it, as shells say.
  int exit_status = -1;
  std::string out;
  std::string err;
  /// The most memory that it had.
  std::size_t peak_bytes = 0;
};

/// One that runs. Standard output and error go to files, so that it never waits for a reader.
class BerthProgram {
 public:
  /// Starts it with this folder as its working directory, and with this terminal for standard error
  /// unless it is empty.
  BerthProgram(const std::filesystem::path& folder, const std::vector<std::string>& arguments,
               const std::filesystem::path& terminal = {});
  /// Ends it if it still runs.
  ~BerthProgram();
  BerthProgram(const BerthProgram&) = delete;
  BerthProgram& operator=(const BerthProgram&) = delete;

  /// As Ctrl-C does.
  void interrupt();
  Outcome wait();

 private:
  TemporaryFolder streams_;
  pid_t process_ = 0;
};

Outcome run_berth(const std::filesystem::path& folder, const std::vector<std::string>& arguments);

}  // namespace berth
