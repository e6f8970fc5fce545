// Inside scene/ only: the paths of a scene file for a copy of it in another folder.
#pragma once

#include <filesystem>
#include <string>

namespace berth {

/// Whether both lead to one place, through symbolic links too; nothing has to be there. Both are
/// without "..", or as if it were taken away by the text alone.
bool is_same_path(const std::filesystem::path& a, const std::filesystem::path& b);

/// From one file's folder to another's.
class PathMove {
 public:
  PathMove(const std::filesystem::path& from_file, const std::filesystem::path& to_file);

  /// The same file, relative to the new folder; absolute where it was, or where symbolic links make
  /// ".." lead elsewhere under another name of that folder. As it is where the folder stays.
  std::filesystem::path path(const std::filesystem::path& path) const;
  /// The same for a pattern as glob_files() takes it.
  std::string pattern(const std::string& pattern) const;

 private:
  std::filesystem::path from_;
  std::filesystem::path to_;
  bool stays_;
};

}  // namespace berth
