// Whole files, in and out.
#pragma once

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <string>
#include <string_view>

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

/// A file that is written piece by piece, under a temporary name beside it, and takes its own name
/// when it is kept: until then `file` is as it was before. One that is not kept is removed. Each
/// throws std::runtime_error where the folder is missing or cannot be written to, the disk is full,
/// or `file` is there and no regular file.
class FileInParts {
 public:
  explicit FileInParts(std::filesystem::path file);
  ~FileInParts();
  FileInParts(const FileInParts&) = delete;
  FileInParts& operator=(const FileInParts&) = delete;

  /// The bytes are with the system afterwards. Where it throws, none of them is in the file, and
  /// what was written before can be kept.
  void write(std::string_view bytes);
  void keep();

 private:
  [[noreturn]] void fail(int error) const;
  [[noreturn]] void drop_cut_piece(int error);

  std::filesystem::path file_;
  std::filesystem::path temporary_;
  std::ofstream out_;
  std::uintmax_t whole_bytes_ = 0;
};

/// The same at once: afterwards `file` is complete, or as it was before.
void write_file_bytes(const std::filesystem::path& file, std::string_view bytes);

}  // namespace berth
