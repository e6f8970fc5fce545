// One form for every message about a bad file.
#pragma once

#include <filesystem>
#include <stdexcept>
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

/// What throw_bad_file() throws.
class BadFile : public std::runtime_error {
 public:
  BadFile(FilePlace place, std::string_view found, std::string_view expected);
  const FilePlace& place() const { return place_; }
  /// The message without file and line: "<where>: <found>; expected <expected>".
  const std::string& without_line() const { return without_line_; }

 private:
  FilePlace place_;
  std::string without_line_;
};

/// Throws BadFile with the message "<file>:<line>: <where>: <found>; expected <expected>", where
/// `found` is the bad value or what is wrong.
[[noreturn]] void throw_bad_file(const FilePlace& place, std::string_view found,
                                 std::string_view expected);

}  // namespace berth
