#pragma once

#include <filesystem>
#include <string>

#include "apps/berth/arguments.hpp"
#include "berth/scene/frame_result.hpp"

namespace berth::app {

/// Where results go: standard output at once, or a file that appears complete when all is done.
class Output {
 public:
  /// Throws std::runtime_error where the file could not be written at the end, so that nobody waits
  /// for results in vain.
  Output(OutputFormat format, std::filesystem::path file);

  /// Throws std::runtime_error where it cannot be written.
  void write(const FrameResult& result);
  void finish();

 private:
  OutputFormat format_;
  std::filesystem::path file_;
  std::string kept_;
};

}  // namespace berth::app
