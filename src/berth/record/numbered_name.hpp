// Inside record/ only.
#pragma once

#include <fmt/format.h>

#include <filesystem>

namespace berth {

/// FILE.mcap, FILE_2.mcap, ...: the i-th, from 1 on.
inline std::filesystem::path numbered(const std::filesystem::path& file, int i) {
  if (i == 1) return file;
  std::filesystem::path other = file;
  return other.replace_filename(
      fmt::format("{}_{}{}", file.stem().string(), i, file.extension().string()));
}

}  // namespace berth
