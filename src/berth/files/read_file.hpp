#pragma once

#include <filesystem>
#include <stdexcept>
#include <string>

namespace berth {

/// A file that there is not.
class MissingFile : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// All bytes of a regular file of at most 1 GiB: a pipe may keep its reader for ever, a device has
/// no end. Throws MissingFile, or another std::runtime_error, that names the file, what is there,
/// and what was expected.
std::string read_file_bytes(const std::filesystem::path& file);

}  // namespace berth
