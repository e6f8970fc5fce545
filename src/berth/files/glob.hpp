#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace berth {

/// The files that match a shell pattern (glob(3)), relative to `folder` unless it is absolute;
/// numbers in the names are sorted by value, so 9.png stands before 10.png, and times whose last
/// zeros were cut as times: 1.16.png before 1.7.png. None match: an empty list.
std::vector<std::filesystem::path> glob_files(const std::filesystem::path& folder,
                                              const std::string& pattern);

/// The pattern that only `text` itself matches.
std::string escape_glob(const std::string& text);

/// Whether looking for the pattern's files is quick wherever it stands: wildcards in two parts of
/// the path at most, and eight stars.
bool is_quick_pattern(const std::string& pattern);

}  // namespace berth
