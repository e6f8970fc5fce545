#pragma once

#include <filesystem>
#include <fstream>
#include <string>

#include "lab/bench/table.hpp"

namespace berth::lab {

/// Where tables go as soon as they are known: to standard output, and as Markdown into a file.
/// Begins with the machine.
class Report {
 public:
  /// No folder: standard output alone. `gl_renderer` is a part of the machine, where it is used.
  /// Throws std::runtime_error where the folder cannot be made or written to.
  explicit Report(const std::filesystem::path& folder, const std::string& gl_renderer = "",
                  const std::string& file_name = "results.md");

  /// Throws std::runtime_error where the file cannot be written.
  void add(const Table& table);

 private:
  /// Empty: there is none.
  std::filesystem::path file_;
  std::ofstream markdown_;
};

}  // namespace berth::lab
