#include "berth/files/file_bytes.hpp"

#include <fmt/format.h>

#include <cerrno>
#include <random>
#include <system_error>
#include <utility>

#include "berth/files/error.hpp"

namespace berth {
namespace {

namespace fs = std::filesystem;

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
