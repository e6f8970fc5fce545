// Whole files, in and out.
#pragma once

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <string_view>

#include "berth/files/read_file.hpp"

namespace berth {

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
