#include "berth/files/glob.hpp"

#include <glob.h>
#include <string.h>

#include <algorithm>
#include <new>

namespace berth {

std::string escape_glob(const std::string& text) {
  std::string escaped;
  for (const char c : text) {
    if (std::string_view("*?[]\\").find(c) != std::string_view::npos) escaped += '\\';
    escaped += c;
  }
  return escaped;
}

bool is_quick_pattern(const std::string& pattern) {
  int parts = 0;
  for (const std::filesystem::path& part : std::filesystem::path(pattern)) {
    parts += part.string().find_first_of("*?[") != std::string::npos;
  }
  return parts <= 2 && std::count(pattern.begin(), pattern.end(), '*') <= 8;
}

std::vector<std::filesystem::path> glob_files(const std::filesystem::path& folder,
                                              const std::string& pattern) {
  const bool absolute = pattern.starts_with('/');
  // The folder's own name is meant letter by letter.
  const std::string full = absolute ? pattern : escape_glob((folder / "").string()) + pattern;
  glob_t found{};
  const int code = ::glob(full.c_str(), GLOB_NOSORT, nullptr, &found);
  std::vector<std::string> names;
  if (code == 0) names.assign(found.gl_pathv, found.gl_pathv + found.gl_pathc);
  ::globfree(&found);
  if (code == GLOB_NOSPACE) throw std::bad_alloc();
  std::sort(names.begin(), names.end(), [](const std::string& a, const std::string& b) {
    return ::strverscmp(a.c_str(), b.c_str()) < 0;
  });
  std::vector<std::filesystem::path> files;
  for (const std::string& name : names) {
    files.push_back(std::filesystem::path(name).lexically_normal());
  }
  return files;
}

}  // namespace berth
