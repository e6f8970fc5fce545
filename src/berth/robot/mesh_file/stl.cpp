#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <cstring>
#include <stdexcept>
#include <string_view>
#include <utility>

#include "berth/files/number.hpp"
#include "berth/files/xml.hpp"
#include "berth/robot/mesh_file/formats.hpp"
#include "berth/robot/mesh_file/mesh_file.hpp"

namespace berth {
namespace {

constexpr std::size_t kHeader = 84;
constexpr std::size_t kTriangle = 50;
constexpr std::string_view kBlanks = " \t\r\n\v\f";

using Corners = std::array<Eigen::Vector3f, 3>;

void append_triangle(const Corners& corners, Polygons& polygons) {
  const auto first = static_cast<std::uint32_t>(polygons.vertices_m.size());
  polygons.vertices_m.insert(polygons.vertices_m.end(), corners.begin(), corners.end());
  polygons.faces.push_back({first, first + 1, first + 2});
}

/// solid NAME, facets, endsolid NAME; several times where there are several solids.
class TextStl {
 public:
  /// In small letters.
  TextStl(const std::filesystem::path& path, const std::string& text) : path_(path), text_(text) {}

  Polygons read() {
    for (std::string word = next(); !word.empty(); word = next()) {
      if (word == "outer" || word == "end") word += next();
      if (word == "solid" || word == "endsolid") {
        at_ = std::min(text_.find('\n', at_), text_.size());
      } else if (word == "facet") {
        if (const std::string normal = next(); normal != "normal")
          fail(fmt::format("\"{:.40}\"", normal), "normal");
        for (int i = 0; i < 3; ++i) next();
      } else if (word == "outerloop") {
        count_ = 0;
      } else if (word == "vertex") {
        add_corner();
      } else if (word == "endloop") {
        if (count_ != 3) fail(fmt::format("a loop of {} corners", count_), "three");
        append_triangle(corners_, polygons_);
      } else if (word != "endfacet") {
        fail(fmt::format("\"{:.40}\"", word),
             "solid, facet, outer loop, vertex, endloop, endfacet or endsolid");
      }
    }
    if (polygons_.faces.empty()) fail("no facet", "one at least");
    return std::move(polygons_);
  }

 private:
  /// Empty at the end.
  std::string next() {
    const auto begin = std::min(text_.find_first_not_of(kBlanks, at_), text_.size());
    at_ = std::min(text_.find_first_of(kBlanks, begin), text_.size());
    return text_.substr(begin, at_ - begin);
  }

  void add_corner() {
    for (int i = 0; i < 3; ++i) {
      const std::string word = next();
      const auto number = parse_finite(word);
      if (!number)
        fail(fmt::format("{} of a vertex is \"{:.40}\"", "xyz"[i], word), "finite numbers");
      corners_[std::min<std::size_t>(count_, 2)][i] = static_cast<float>(*number);
    }
    ++count_;
  }

  [[noreturn]] void fail(const std::string& found, std::string_view expected) const {
    throw std::runtime_error(fmt::format("{}:{}: {}; expected {}", path_.string(),
                                         line_of(text_, static_cast<std::ptrdiff_t>(at_)), found,
                                         expected));
  }

  const std::filesystem::path& path_;
  const std::string& text_;
  std::size_t at_ = 0;
  Corners corners_;
  std::size_t count_ = 0;
  Polygons polygons_;
};

/// Zero where the bytes end before.
template <typename Number>
Number number_at(const std::string& bytes, std::size_t place) {
  Number number{};
  if (place + sizeof number <= bytes.size())
    std::memcpy(&number, bytes.data() + place, sizeof number);
  return number;
}

/// In small letters and without what is behind its last word: some programs end it with a zero byte
/// or as DOS did. Empty where it is none: a binary one may begin with "solid" too, but the last
/// byte of its count is 0.
std::string text_of(std::string bytes) {
  if (bytes.substr(0, kHeader).find('\0', kHeader - 4) != std::string::npos) return "";
  bytes.erase(bytes.find_last_not_of(std::string_view(" \t\r\n\v\f\x1A\0", 8)) + 1);
  std::transform(bytes.begin(), bytes.end(), bytes.begin(), [](char c) {
    return 'A' <= c && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  });
  const auto begin = bytes.find_first_not_of(kBlanks);
  return begin != std::string::npos && bytes.compare(begin, 5, "solid") == 0 ? bytes : "";
}

/// Whether what stands behind the triangles may be more of them: whole ones, or those of another
/// STL, and not one byte over and over that fills a block.
bool holds_more(std::string_view behind) {
  return !behind.empty() && behind.find_first_not_of(behind[0]) != std::string_view::npos &&
         (behind.size() % kTriangle == 0 || behind.size() % kTriangle == kHeader % kTriangle);
}

Polygons read_binary(const std::string& bytes, std::size_t size) {
  Polygons polygons;
  for (std::size_t place = kHeader; place < size; place += kTriangle) {
    Corners corners;
    // Behind the normal.
    for (std::size_t i = 0; i < 9; ++i)
      corners[i / 3][static_cast<int>(i % 3)] = number_at<float>(bytes, place + 12 + 4 * i);
    append_triangle(corners, polygons);
  }
  return polygons;
}

}  // namespace

Polygons read_stl_polygons(const std::filesystem::path& path, const std::string& bytes) {
  const std::size_t count = number_at<std::uint32_t>(bytes, kHeader - 4);
  const std::size_t size = kHeader + kTriangle * count;
  std::string expected = fmt::format("{} bytes as its header says", size);
  if (count > 0 && bytes.size() >= size) {
    if (!holds_more(std::string_view(bytes).substr(size))) return read_binary(bytes, size);
  } else if (const std::string text = text_of(bytes); !text.empty()) {
    const auto end = text.substr(text.find_last_of("\r\n") + 1);
    if (end.find("endsolid") != std::string::npos || end.find("end solid") != std::string::npos)
      return TextStl(path, text).read();
    expected = "\"endsolid\" in the last line of such a text";
  } else if (count == 0) {
    expected = "text from \"solid\" to \"endsolid\", or 84 and 50 for each triangle";
  }
  throw std::runtime_error(fmt::format("{}: the STL holds {} bytes; expected {}", path.string(),
                                       bytes.size(), expected));
}

namespace {

/// The least significant byte first, whatever the machine's order.
void append_word(std::uint32_t word, std::string& bytes) {
  for (int shift = 0; shift < 32; shift += 8) bytes += static_cast<char>(word >> shift & 0xFF);
}

void append_vector(const Eigen::Vector3f& vector, std::string& bytes) {
  for (const float value : vector) append_word(std::bit_cast<std::uint32_t>(value), bytes);
}

}  // namespace

std::string stl_bytes(const TriangleMesh& mesh) {
  std::string bytes = "made by berth";
  bytes.resize(kHeader - 4, ' ');
  append_word(static_cast<std::uint32_t>(mesh.triangles.size()), bytes);
  for (const auto& [a, b, c] : mesh.triangles) {
    const Eigen::Vector3f& p = mesh.vertices_m[a];
    const Eigen::Vector3f& q = mesh.vertices_m[b];
    const Eigen::Vector3f& r = mesh.vertices_m[c];
    append_vector((q - p).cross(r - p).normalized(), bytes);
    for (const Eigen::Vector3f* corner : {&p, &q, &r}) append_vector(*corner, bytes);
    bytes.append(2, '\0');
  }
  return bytes;
}

}  // namespace berth
