#include "berth/robot/obj_guard.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>
#include <string_view>
#include <vector>

#include "berth/robot/number.hpp"

namespace berth {
namespace {

constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";
constexpr std::string_view kBlanks = " \t\r\v\f";

// A larger polygon takes Assimp seconds to cut into triangles.
constexpr std::size_t kMostCorners = 4096;

std::vector<std::string_view> words_of(std::string_view line) {
  std::vector<std::string_view> words;
  line = line.substr(0, line.find('#'));
  for (std::size_t begin = line.find_first_not_of(kBlanks); begin != std::string_view::npos;
       begin = line.find_first_not_of(kBlanks)) {
    line.remove_prefix(begin);
    words.push_back(line.substr(0, line.find_first_of(kBlanks)));
    line.remove_prefix(words.back().size());
  }
  return words;
}

class ObjText {
 public:
  ObjText(const std::filesystem::path& path, std::string_view text) : path_(path), rest_(text) {
    if (rest_.starts_with(kByteOrderMark)) rest_.remove_prefix(kByteOrderMark.size());
  }

  std::string checked() {
    while (!rest_.empty()) {
      const std::string line = next_line();
      const std::vector<std::string_view> words = words_of(line);
      if (words.empty()) continue;
      if (words[0] == "v") add_vertex(words);
      if (words[0] == "f") add_face(words);
    }
    line_ = line_of_greatest_;
    if (greatest_index_ > vertices_) fail_index(std::to_string(greatest_index_));
    if (faces_ == 0) {
      throw std::runtime_error(fmt::format(
          "{}: the mesh has no face of three corners or more; expected one", path_.string()));
    }
    return checked_;
  }

 private:
  /// With the lines that go on behind a backslash.
  std::string next_line() {
    line_ = next_line_;
    std::string line;
    for (bool goes_on = true; goes_on;) {
      std::string_view piece = rest_.substr(0, rest_.find('\n'));
      rest_.remove_prefix(std::min(piece.size() + 1, rest_.size()));
      ++next_line_;
      if (piece.ends_with('\r')) piece.remove_suffix(1);
      goes_on = piece.ends_with('\\') && !rest_.empty();
      if (goes_on) piece.remove_suffix(1);
      line.append(piece);
      if (goes_on) line += ' ';
    }
    if (line.find('\0') != std::string::npos) fail("a zero byte", "plain text, not UTF-16");
    return line;
  }

  /// x y z, x y z w or x y z and a color.
  void add_vertex(const std::vector<std::string_view>& words) {
    if (words.size() != 4 && words.size() != 5 && words.size() != 7) {
      fail(fmt::format("a vertex of {} numbers", words.size() - 1), "3, 4 (with w) or 6 (a color)");
    }
    for (std::size_t i = 1; i < words.size(); ++i) {
      const auto value = parse_finite(words[i]);
      if (!value)
        fail(fmt::format("vertex {}: \"{:.40}\"", vertices_ + 1, words[i]), "a finite number");
      if (words.size() == 5 && i == 4 && *value == 0) {
        fail(fmt::format("vertex {}: w is {}", vertices_ + 1, words[i]), "a number other than 0");
      }
    }
    checked_ += 'v';
    for (std::size_t i = 1; i < std::min<std::size_t>(words.size(), 5); ++i) {
      if (words.size() == 7 && i == 4) break;
      checked_.append(" ").append(words[i]);
    }
    checked_ += '\n';
    ++vertices_;
  }

  void add_face(const std::vector<std::string_view>& words) {
    if (words.size() > kMostCorners + 1) {
      fail(fmt::format("a face of {} corners", words.size() - 1),
           fmt::format("{} at most", kMostCorners));
    }
    std::string line = "f";
    for (std::size_t i = 1; i < words.size(); ++i) {
      line += fmt::format(" {}", vertex_index(words[i]));
    }
    // Points and lines have no surface.
    if (words.size() < 4) return;
    checked_ += line + '\n';
    ++faces_;
  }

  /// Of a corner such as 3, 3/1, 3//2 or -1/1/2, counted from 1.
  int vertex_index(std::string_view corner) {
    const auto index = parse_integer(corner.substr(0, corner.find('/')));
    if (!index || *index == 0 || corner.find_first_not_of("0123456789-+/") != corner.npos) {
      fail_index(corner);
    }
    if (*index < 0 && *index < -vertices_) fail_index(corner);
    if (*index < 0) return vertices_ + 1 + *index;
    if (*index > greatest_index_) {
      greatest_index_ = *index;
      line_of_greatest_ = line_;
    }
    return *index;
  }

  [[noreturn]] void fail_index(std::string_view corner) const {
    fail(fmt::format("a face's corner is \"{:.40}\"", corner),
         fmt::format("the number of one of the {} vertices", vertices_));
  }

  [[noreturn]] void fail(std::string_view found, std::string_view expected) const {
    throw std::runtime_error(
        fmt::format("{}:{}: {}; expected {}", path_.string(), line_, found, expected));
  }

  const std::filesystem::path& path_;
  std::string_view rest_;
  std::string checked_;
  int line_ = 1;
  int next_line_ = 1;
  int vertices_ = 0;
  int faces_ = 0;
  int greatest_index_ = 0;
  int line_of_greatest_ = 0;
};

}  // namespace

std::string checked_obj(const std::filesystem::path& path, const std::string& text) {
  return ObjText(path, text).checked();
}

}  // namespace berth
