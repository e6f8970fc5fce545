// What has been measured so far, on disk, so that a study that was stopped goes on where it was.
#pragma once

#include <filesystem>
#include <map>
#include <mutex>
#include <string>
#include <unordered_set>

namespace berth::lab {

/// What has to be the same for two runs to be one study: commit, seed, scenes, machine ...
using Identity = std::map<std::string, std::string>;

/// A folder with study.json, which reports the identity, and measurements.csv, one line for each
/// scene and parameter set, each of them whole: one that was cut while it was written is dropped.
class Journal {
 public:
  /// Begins a study, or goes on with the one that is there. `header` names the columns, of which
  /// the first `key_columns` say what was measured. Throws std::runtime_error where the folder
  /// cannot be written to, is that of another study (naming what differs), or has a line that is
  /// none of this journal's.
  Journal(const std::filesystem::path& folder, const Identity& identity, std::string header,
          int key_columns);
  ~Journal();
  Journal(const Journal&) = delete;
  Journal& operator=(const Journal&) = delete;

  bool has(const std::string& key) const { return keys_.contains(key); }
  /// Lines that were there when it was opened.
  std::size_t found_lines() const { return keys_.size(); }
  /// May be called by several threads. Throws std::runtime_error where the disk is full.
  void add(const std::string& key, const std::string& values);

 private:
  std::filesystem::path file_;
  std::unordered_set<std::string> keys_;
  std::mutex mutex_;
  int descriptor_ = -1;
};

}  // namespace berth::lab
