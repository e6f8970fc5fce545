#pragma once

#include <cstdint>
#include <filesystem>
#include <stdexcept>
#include <string>

namespace berth {

/// A file that there is not.
class MissingFile : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// 1 GiB.
inline constexpr std::uintmax_t kMostFileBytes = std::uintmax_t{1} << 30;

/// All bytes of a regular file of at most 1 GiB: a pipe may keep its reader for ever, a device has
/// no end. A pointer of Git LFS, which stands in place of a file, is refused. Throws
/// MissingFile, or another std::runtime_error, that names the file, what is there,
/// and what was expected.
std::string read_file_bytes(const std::filesystem::path& file);

/// How a file begins and ends.
struct FileEnds {
  std::string first;
  std::string last;
};

/// The first and the last `count` bytes, or all where it has fewer. Throws as read_file_bytes does,
/// of a file of more than `most_bytes` too.
FileEnds read_file_ends(const std::filesystem::path& file, std::size_t count,
                        std::uintmax_t most_bytes = kMostFileBytes);

}  // namespace berth
