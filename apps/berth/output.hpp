#pragma once

#include <filesystem>
#include <string>

#include "apps/berth/arguments.hpp"
#include "berth/pipeline/result.hpp"

namespace berth::app {

/// Where results go: standard output at once, or a file that appears complete when all is done.
class Output {
 public:
  /// Throws std::runtime_error where the file could not be written at the end, so that nobody waits
  /// for results in vain.
  explicit Output(const CommonArguments& arguments);

  /// Throws std::runtime_error where it cannot be written.
  void write(const Result& result);
  void finish();

 private:
  OutputFormat format_;
  int schema_;
  std::filesystem::path file_;
  std::string kept_;
};

}  // namespace berth::app
