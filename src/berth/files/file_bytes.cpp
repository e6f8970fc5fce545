#include "berth/files/file_bytes.hpp"

#include <fmt/format.h>

#include <cerrno>
#include <fstream>
#include <random>
#include <system_error>

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
