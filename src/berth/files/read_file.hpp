#pragma once

#include <filesystem>
#include <string>

namespace berth {

/// All bytes of a regular file of at most 1 GiB: a pipe may keep its reader for ever, a device has
/// no end. Throws std::runtime_error that names the file, what is there, and what was expected.
std::string read_file_bytes(const std::filesystem::path& file);

}  // namespace berth
