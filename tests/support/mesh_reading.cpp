#include "tests/support/mesh_reading.hpp"

#include <algorithm>
#include <cctype>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <iterator>
#include <sstream>
#include <stdexcept>

#include "tests/support/dae_reading.hpp"

namespace berth {
namespace {

template <typename T>
T number_at(const std::string& bytes, std::size_t offset) {
  T number;
  std::memcpy(&number, bytes.data() + offset, sizeof number);
  return number;
}

TriangleSoup read_binary_stl(const std::string& bytes, std::uint32_t count) {
  TriangleSoup soup(count);
  for (std::size_t t = 0; t < count; ++t) {
    for (std::size_t corner = 0; corner < 3; ++corner) {
      for (std::size_t axis = 0; axis < 3; ++axis) {
        const std::size_t offset = 84 + 50 * t + 12 + 12 * corner + 4 * axis;
        soup[t][corner][static_cast<Eigen::Index>(axis)] = number_at<float>(bytes, offset);
      }
    }
  }
  return soup;
}

TriangleSoup read_text_stl(const std::string& bytes) {
  TriangleSoup soup;
  std::vector<Eigen::Vector3d> facet;
  std::istringstream words(bytes);
  for (std::string word; words >> word;) {
    if (word != "vertex") continue;
    Eigen::Vector3d p;
    words >> p.x() >> p.y() >> p.z();
    facet.push_back(p);
    if (facet.size() < 3) continue;
    append_fan(facet, soup);
    facet.clear();
  }
  return soup;
}

TriangleSoup read_stl(const std::string& bytes) {
  // A binary STL may begin with "solid" too: only its size decides.
  if (bytes.size() >= 84) {
    const auto count = number_at<std::uint32_t>(bytes, 80);
    if (bytes.size() == 84 + 50 * std::size_t{count}) return read_binary_stl(bytes, count);
  }
  return read_text_stl(bytes);
}

TriangleSoup read_obj(const std::string& bytes) {
  TriangleSoup soup;
  std::vector<Eigen::Vector3d> vertices;
  std::istringstream lines(bytes);
  for (std::string line; std::getline(lines, line);) {
    std::istringstream words(line);
    std::string kind;
    words >> kind;
    if (kind == "v") {
      Eigen::Vector3d p;
      words >> p.x() >> p.y() >> p.z();
      vertices.push_back(p);
    } else if (kind == "f") {
      std::vector<Eigen::Vector3d> polygon;
      for (std::string corner; words >> corner;) {
        const long index = std::stol(corner);
        const long from_zero = index > 0 ? index - 1 : static_cast<long>(vertices.size()) + index;
        polygon.push_back(vertices.at(static_cast<std::size_t>(from_zero)));
      }
      append_fan(polygon, soup);
    }
  }
  return soup;
}

}  // namespace

std::string read_bytes(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  if (!file) throw std::runtime_error(path.string() + ": cannot be read");
  return {std::istreambuf_iterator<char>(file), {}};
}

void append_fan(const std::vector<Eigen::Vector3d>& polygon, TriangleSoup& soup) {
  for (std::size_t i = 1; i + 1 < polygon.size(); ++i)
    soup.push_back({polygon[0], polygon[i], polygon[i + 1]});
}

TriangleSoup read_triangles(const std::filesystem::path& path) {
  std::string extension = path.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return std::tolower(c); });
  if (extension == ".dae") return read_dae(path);
  if (extension == ".stl") return read_stl(read_bytes(path));
  if (extension == ".obj") return read_obj(read_bytes(path));
  throw std::runtime_error(path.string() + ": expected .stl, .obj or .dae");
}

}  // namespace berth
