#include "berth/robot/mesh_file/stl_guard.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <stdexcept>
#include <string_view>

#include "berth/files/number.hpp"

namespace berth {
namespace {

constexpr std::size_t kHeader = 84;
// Assimp knows no others.
constexpr std::string_view kStlBlanks = " \t\r\n";

/// A text word by word, with the line of the last one.
class Words {
 public:
  explicit Words(std::string_view text) : rest_(text) {}

  /// Empty at the end.
  std::string_view next() {
    skip(std::min(rest_.find_first_not_of(kStlBlanks), rest_.size()));
    return skip(std::min(rest_.find_first_of(kStlBlanks), rest_.size()));
  }
  void skip_line() { skip(std::min(rest_.find('\n'), rest_.size())); }
  std::ptrdiff_t line() const { return line_; }

 private:
  std::string_view skip(std::size_t count) {
    const std::string_view skipped = rest_.substr(0, count);
    line_ += std::count(skipped.begin(), skipped.end(), '\n');
    rest_.remove_prefix(count);
    return skipped;
  }

  std::string_view rest_;
  std::ptrdiff_t line_ = 1;
};

/// solid NAME, facets, endsolid NAME; several times where there are several solids.
class TextStl {
 public:
  TextStl(const std::filesystem::path& path, std::string& text)
      : path_(path), text_(text), words_(text) {}

  void check() {
    if (text_.find('\0') != std::string::npos) fail("the text has a zero byte", "letters");
    for (std::string_view word = words_.next(); !word.empty(); word = words_.next()) {
      if (word == "solid" || word == "endsolid") {
        words_.skip_line();
      } else if (word == "facet") {
        expect("normal");
        for (int i = 0; i < 3; ++i) set_to_zero(words_.next());
      } else if (word == "outer") {
        expect("loop");
        corners_ = 0;
      } else if (word == "vertex") {
        check_vertex();
      } else if (word == "endloop") {
        if (corners_ != 3) fail(fmt::format("a loop of {} corners", corners_), "three");
        ++facets_;
      } else if (word != "endfacet") {
        fail(fmt::format("\"{:.40}\"", word),
             "solid, facet, outer loop, vertex, endloop, endfacet or endsolid");
      }
    }
    if (facets_ == 0) fail("no facet", "one at least");
  }

 private:
  void set_to_zero(std::string_view word) {
    if (word.empty()) fail("the normal is cut", "three numbers");
    const auto begin = text_.begin() + (word.data() - text_.data());
    std::fill(begin, begin + static_cast<std::ptrdiff_t>(word.size()), ' ');
    *begin = '0';
  }

  void check_vertex() {
    for (const char axis : {'x', 'y', 'z'}) {
      const std::string_view word = words_.next();
      if (!parse_finite(word)) {
        fail(fmt::format("{} of a vertex is \"{:.40}\"", axis, word), "finite numbers");
      }
    }
    ++corners_;
  }

  void expect(std::string_view expected) {
    const std::string_view word = words_.next();
    if (word != expected) fail(fmt::format("\"{:.40}\"", word), expected);
  }

  [[noreturn]] void fail(const std::string& found, std::string_view expected) const {
    throw std::runtime_error(
        fmt::format("{}:{}: {}; expected {}", path_.string(), words_.line(), found, expected));
  }

  const std::filesystem::path& path_;
  std::string& text_;
  Words words_;
  int corners_ = 0;
  int facets_ = 0;
};

bool ends_with_endsolid(const std::string& text) {
  const auto end = text.find_last_not_of(" \t\r\n");
  if (end == std::string::npos) return false;
  const auto line = text.find_last_of("\r\n", end) + 1;
  return text.compare(text.find_first_not_of(" \t", line), 8, "endsolid") == 0;
}

/// 0 where the header is cut.
std::size_t binary_size(const std::string& bytes) {
  constexpr std::size_t kTriangle = 50;
  if (bytes.size() < kHeader) return 0;
  std::uint32_t count = 0;
  std::copy_n(bytes.data() + kHeader - sizeof count, sizeof count, reinterpret_cast<char*>(&count));
  return kHeader + kTriangle * count;
}

}  // namespace

std::string checked_stl(const std::filesystem::path& path, std::string bytes) {
  const std::size_t size = binary_size(bytes);
  if (size == kHeader && bytes.size() == size) {
    throw std::runtime_error(
        fmt::format("{}: the STL has 0 triangles; expected one at least", path.string()));
  }
  if (bytes.size() == size) return bytes;
  if (!bytes.starts_with("solid") || !ends_with_endsolid(bytes)) {
    throw std::runtime_error(fmt::format(
        "{}: the STL holds {} bytes; expected text from \"solid\" to \"endsolid\", or {} bytes as "
        "its header says",
        path.string(), bytes.size(), size == 0 ? "at least 84" : std::to_string(size)));
  }
  TextStl(path, bytes).check();
  return bytes;
}

}  // namespace berth
