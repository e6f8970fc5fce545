#include "berth/files/file_bytes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <random>
#include <stdexcept>
#include <system_error>
#include <utility>

#include "berth/files/error.hpp"

namespace berth {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void fail(const fs::path& file, std::string_view found, std::string_view expected) {
  throw std::runtime_error(fmt::format("{}: {}; expected {}", file.string(), found, expected));
}

struct OpenFile {
  std::ifstream in;
  std::uintmax_t size;
};

OpenFile open_file(const fs::path& file, std::uintmax_t most_bytes) {
  std::error_code error;
  const fs::file_status status = fs::status(file, error);
  if (fs::is_directory(status)) fail(file, "is a folder", "a file");
  if (error == std::errc::no_such_file_or_directory) {
    throw MissingFile(
        fmt::format("{}: {}; expected a readable file", file.string(), error.message()));
  }
  if (error) fail(file, error.message(), "a readable file");
  if (!fs::is_regular_file(status)) fail(file, "is a pipe or device", "a regular file");
  const std::uintmax_t size = fs::file_size(file);
  if (size > most_bytes) {
    fail(file, fmt::format("holds {} bytes", size), fmt::format("{} at most", most_bytes));
  }
  errno = 0;
  std::ifstream in(file, std::ios::binary);
  if (!in) fail(file, std::strerror(errno), "a readable file");
  return {std::move(in), size};
}

std::string read_next(const fs::path& file, std::ifstream& in, std::uintmax_t count) {
  std::string bytes(count, '\0');
  in.read(bytes.data(), static_cast<std::streamsize>(count));
  if (!in) fail(file, "reading failed", "a readable file");
  return bytes;
}

void require_content(const fs::path& file, std::string_view bytes) {
  if (bytes.starts_with("version https://git-lfs"))
    fail(file, "is a pointer of Git LFS", "the file itself, which git lfs pull brings");
}

}  // namespace

std::string read_file_bytes(const fs::path& file) {
  auto [in, size] = open_file(file, kMostFileBytes);
  std::string bytes = read_next(file, in, size);
  require_content(file, bytes);
  return bytes;
}

FileEnds read_file_ends(const fs::path& file, std::size_t count, std::uintmax_t most_bytes) {
  auto [in, size] = open_file(file, most_bytes);
  const std::uintmax_t part = std::min<std::uintmax_t>(count, size);
  FileEnds ends;
  ends.first = read_next(file, in, part);
  require_content(file, ends.first);
  in.seekg(static_cast<std::streamoff>(size - part));
  ends.last = read_next(file, in, part);
  return ends;
}

namespace {

fs::path temporary_beside(const fs::path& file) {
  fs::path temporary = file;
  temporary += fmt::format(".part-{:08x}", std::random_device()());
  return temporary;
}

}  // namespace

FileInParts::FileInParts(fs::path file)
    : file_(std::move(file)), temporary_(temporary_beside(file_)) {
  // A rename would put a file in the place of a device such as /dev/stdout.
  if (fs::exists(file_) && !fs::is_regular_file(file_)) {
    throw_bad_file({file_}, "is there and no regular file", "a file or a free name to write to");
  }
  errno = 0;
  out_.open(temporary_, std::ios::binary);
  if (!out_) fail(errno);
}

FileInParts::~FileInParts() {
  std::error_code ignored;
  if (!temporary_.empty()) fs::remove(temporary_, ignored);
}

void FileInParts::fail(int error) const {
  throw_bad_file({file_}, "cannot be written: " + std::generic_category().message(error),
                 "an existing folder with leave to write and room");
}

void FileInParts::write(std::string_view bytes) {
  errno = 0;
  out_.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  out_.flush();
  if (!out_) drop_cut_piece(errno);
  whole_bytes_ += bytes.size();
}

void FileInParts::drop_cut_piece(int error) {
  out_.close();
  std::error_code ignored;
  fs::resize_file(temporary_, whole_bytes_, ignored);
  fail(error);
}

void FileInParts::keep() {
  errno = 0;
  if (out_.is_open()) {
    out_.close();
    if (!out_) fail(errno);
  }
  std::error_code error;
  fs::rename(temporary_, file_, error);
  if (error) fail(error.value());
  temporary_.clear();
}

void write_file_bytes(const fs::path& file, std::string_view bytes) {
  FileInParts out(file);
  out.write(bytes);
  out.keep();
}

}  // namespace berth
