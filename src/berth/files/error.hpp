// One form for every message about a bad file.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace berth {

/// A place in a file: line 0 is the file as a whole; `where` may be empty, or a key, a column or a
/// pixel.
struct FilePlace {
  std::filesystem::path file;
  int line = 0;
  std::string where = {};
};

/// Throws std::runtime_error("<file>:<line>: <where>: <found>; expected <expected>"), where `found`
/// is the bad value or what is wrong.
[[noreturn]] void throw_bad_file(const FilePlace& place, std::string_view found,
                                 std::string_view expected);

}  // namespace berth
