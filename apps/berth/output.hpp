#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <string>

#include "apps/berth/arguments.hpp"
#include "berth/files/file_bytes.hpp"
#include "berth/pipeline/result.hpp"
#include "thesis/image_result.hpp"

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
  void write(const ImageResult& result);
  /// A sentence below the tables; none among lines of JSON.
  void close(const std::string& sentence);
  /// The file holds what was written, also where that is not all there would have been.
  void finish();
  std::size_t count() const { return count_; }

 private:
  void put(const std::string& text);

  OutputFormat format_;
  std::optional<FileInParts> out_;
  std::size_t count_ = 0;
};

/// Carries it out; where that ends early, what is thrown says that the file holds what is done.
void keep_what_is_done(const CommonArguments& arguments, Output& output,
                       const std::function<void()>& work);

}  // namespace berth::app
