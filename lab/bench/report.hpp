#pragma once

#include <filesystem>
#include <fstream>
#include <string>

#include "lab/bench/table.hpp"

namespace berth::lab {

/// The files of a report, in its folder.
struct ReportFiles {
  std::string markdown = "results.md";
  std::string csv = "bench.csv";
};

/// Where tables go as soon as they are known: to standard output, and as Markdown and CSV into a
/// folder. Begins with the machine.
class Report {
 public:
  /// No folder: standard output alone. `gl_renderer` is a part of the machine, where it is used.
  /// Throws std::runtime_error where the folder cannot be made or written to.
  explicit Report(const std::filesystem::path& folder, const std::string& gl_renderer = "",
                  const ReportFiles& files = {});

  /// Throws std::runtime_error where the files cannot be written.
  void add(const Table& table);

 private:
  std::filesystem::path folder_;
  ReportFiles files_;
  std::ofstream markdown_;
  std::ofstream csv_;
};

}  // namespace berth::lab
