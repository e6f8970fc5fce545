#include "berth/robot/mesh_file/formats.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <stdexcept>
#include <string_view>
#include <utility>

#include "berth/files/number.hpp"

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

  Polygons read() {
    while (!rest_.empty()) {
      const std::string line = next_line();
      const std::vector<std::string_view> words = words_of(line);
      if (words.empty()) continue;
      if (words[0] == "v") add_vertex(words);
      if (words[0] == "f") add_face(words);
    }
    line_ = line_of_greatest_;
    if (greatest_index_ > vertex_count()) fail_index(std::to_string(greatest_index_));
    if (polygons_.faces.empty()) {
      throw std::runtime_error(fmt::format(
          "{}: the mesh has no face of three corners or more; expected one", path_.string()));
    }
    return std::move(polygons_);
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
    Eigen::Vector3d p_m(coordinate(words[1]), coordinate(words[2]), coordinate(words[3]));
    if (words.size() == 5) {
      const double w = coordinate(words[4]);
      if (w == 0) fail("w of a vertex is 0", "another number");
      p_m /= w;
    }
    polygons_.vertices_m.push_back(p_m.cast<float>());
  }

  double coordinate(std::string_view word) const {
    const std::optional<double> value = parse_finite(word);
    if (!value) fail(fmt::format("a vertex has \"{:.40}\"", word), "finite numbers");
    return *value;
  }

  void add_face(const std::vector<std::string_view>& words) {
    if (words.size() > kMostCorners + 1) {
      fail(fmt::format("a face of {} corners", words.size() - 1),
           fmt::format("{} at most", kMostCorners));
    }
    std::vector<std::uint32_t> face;
    for (std::size_t i = 1; i < words.size(); ++i) face.push_back(vertex_index(words[i]));
    // Points and lines have no surface.
    if (face.size() >= 3) polygons_.faces.push_back(std::move(face));
  }

  /// Of a corner such as 3, 3/1, 3//2 or -1/1/2. A vertex may stand behind its face.
  std::uint32_t vertex_index(std::string_view corner) {
    const std::optional<int> index = parse_integer(corner.substr(0, corner.find('/')));
    if (!index || *index == 0 || *index < -vertex_count()) fail_index(corner);
    if (*index < 0) return static_cast<std::uint32_t>(vertex_count() + *index);
    if (*index > greatest_index_) {
      greatest_index_ = *index;
      line_of_greatest_ = line_;
    }
    return static_cast<std::uint32_t>(*index - 1);
  }

  int vertex_count() const { return static_cast<int>(polygons_.vertices_m.size()); }

  [[noreturn]] void fail_index(std::string_view corner) const {
    fail(fmt::format("a face's corner is \"{:.40}\"", corner),
         fmt::format("the number of one of the {} vertices", vertex_count()));
  }

  [[noreturn]] void fail(std::string_view found, std::string_view expected) const {
    throw std::runtime_error(
        fmt::format("{}:{}: {}; expected {}", path_.string(), line_, found, expected));
  }

  const std::filesystem::path& path_;
  std::string_view rest_;
  Polygons polygons_;
  int line_ = 1;
  int next_line_ = 1;
  int greatest_index_ = 0;
  int line_of_greatest_ = 0;
};

}  // namespace

Polygons read_obj_polygons(const std::filesystem::path& path, const std::string& text) {
  return ObjText(path, text).read();
}

}  // namespace berth
