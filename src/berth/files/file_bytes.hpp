// Whole files, in and out.
#pragma once

#include <filesystem>
#include <string_view>

#include "berth/files/read_file.hpp"

namespace berth {

/// Writes to a temporary file beside `file` and renames it: afterwards `file` is complete, or as it
/// was before. Throws std::runtime_error where the folder is missing or cannot be written to, the
/// disk is full, or `file` is there and no regular file.
void write_file_bytes(const std::filesystem::path& file, std::string_view bytes);

}  // namespace berth
