#include "berth/io/file_bytes.hpp"

#include <fmt/format.h>

#include <cerrno>
#include <cstring>
#include <fstream>
#include <random>
#include <sstream>
#include <system_error>

#include "berth/io/error.hpp"

namespace berth {
namespace {

namespace fs = std::filesystem;

fs::path temporary_beside(const fs::path& file) {
  fs::path temporary = file;
  temporary += fmt::format(".part-{:08x}", std::random_device()());
  return temporary;
}

}  // namespace

std::string read_file_bytes(const fs::path& file) {
  if (fs::is_directory(file)) throw_bad_file({file}, "is a folder", "a file");
  errno = 0;
  std::ifstream in(file, std::ios::binary);
  if (!in) throw_bad_file({file}, std::strerror(errno), "a readable file");
  std::ostringstream bytes;
  if (in.peek() != std::ifstream::traits_type::eof()) bytes << in.rdbuf();
  if (in.bad() || !bytes) throw_bad_file({file}, "reading failed", "a readable file");
  return bytes.str();
}

void write_file_bytes(const fs::path& file, std::string_view bytes) {
  // A rename would put a file in the place of a device such as /dev/stdout.
  if (fs::exists(file) && !fs::is_regular_file(file)) {
    throw_bad_file({file}, "is there and no regular file", "a file or a free name to write to");
  }
  const fs::path temporary = temporary_beside(file);
  errno = 0;
  std::ofstream out(temporary, std::ios::binary);
  out.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  out.close();
  std::error_code error(out ? 0 : errno, std::generic_category());
  if (out) fs::rename(temporary, file, error);
  if (!out || error) {
    std::error_code ignored;
    fs::remove(temporary, ignored);
    throw_bad_file({file}, "cannot be written: " + error.message(),
                   "an existing folder with leave to write and room");
  }
}

}  // namespace berth
