#include "berth/files/glob.hpp"

#include <glob.h>
#include <string.h>

#include <algorithm>
#include <new>
#include <set>

namespace berth {
namespace {

namespace fs = std::filesystem;

/// The decimal number that a name ends with, before its ending.
struct Decimal {
  explicit Decimal(const std::string& name) {
    const std::string stem = fs::path(name).stem();
    whole = stem.substr(stem.find_last_not_of("0123456789.") + 1);
    const std::size_t point = std::min(whole.find('.'), whole.size());
    fraction = whole.substr(std::min(point + 1, whole.size()));
    whole.resize(point);
  }
  std::string whole;
  std::string fraction;
};

/// Times whose last zeros were cut: .7 is .70, and comes after .16. But 3.9 is followed by 3.10
/// where somebody counts, who begins no number with 0.
bool are_times(const std::vector<std::string>& names) {
  constexpr std::size_t kDigitsSince1970 = 9;
  std::set<std::size_t> lengths;
  bool is_time = false;
  for (const std::string& name : names) {
    const Decimal decimal(name);
    if (decimal.whole.empty() || decimal.fraction.find('.') != std::string::npos) return false;
    lengths.insert(decimal.fraction.size());
    is_time |= decimal.whole.size() >= kDigitsSince1970 ||
               (decimal.fraction.size() > 1 && decimal.fraction[0] == '0');
  }
  return is_time && lengths.size() > 1;
}

bool is_earlier(const std::string& a, const std::string& b) {
  const Decimal x(a), y(b);
  const int order = ::strverscmp(x.whole.c_str(), y.whole.c_str());
  return order != 0 ? order < 0 : x.fraction < y.fraction;
}

}  // namespace

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
  std::ranges::sort(names, [](const std::string& a, const std::string& b) {
    return ::strverscmp(a.c_str(), b.c_str()) < 0;
  });
  if (are_times(names)) std::ranges::stable_sort(names, is_earlier);
  std::vector<std::filesystem::path> files;
  for (const std::string& name : names) {
    files.push_back(std::filesystem::path(name).lexically_normal());
  }
  return files;
}

}  // namespace berth
