#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace berth {

/// The files that match a shell pattern (glob(3)), relative to `folder` unless it is absolute;
/// numbers in the names are sorted by value, so 9.png stands before 10.png. None match: an empty
/// list.
std::vector<std::filesystem::path> glob_files(const std::filesystem::path& folder,
                                              const std::string& pattern);

}  // namespace berth
