#pragma once

#include <cstddef>
#include <optional>

#include "apps/berth/arguments.hpp"
#include "berth/files/file_bytes.hpp"
#include "berth/pipeline/result.hpp"

namespace berth::app {

/// Where results go, each as soon as it is there: standard output, or a file that appears when it
/// is finished.
class Output {
 public:
  /// Throws std::runtime_error where the file cannot be written, so that nobody waits for results
  /// in vain.
  explicit Output(const CommonArguments& arguments);

  /// Throws std::runtime_error where it cannot be written.
  void write(const Result& result);
  /// The file holds what was written, also where that is not all there would have been.
  void finish();
  std::size_t count() const { return count_; }

 private:
  OutputFormat format_;
  std::optional<FileInParts> out_;
  std::size_t count_ = 0;
};

}  // namespace berth::app
