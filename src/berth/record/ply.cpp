#include "berth/record/ply.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <stdexcept>

namespace berth {
namespace {

static_assert(std::endian::native == std::endian::little);

constexpr std::size_t kVertexBytes = 3 * sizeof(float);
constexpr std::size_t kFaceBytes = 1 + 3 * sizeof(std::uint32_t);

std::string header_of(std::size_t vertices, std::size_t faces) {
  return fmt::format(
      "ply\nformat binary_little_endian 1.0\nelement vertex {}\nproperty float x\nproperty float "
      "y\nproperty float z\nelement face {}\nproperty list uchar uint vertex_indices\nend_header\n",
      vertices, faces);
}

/// The number after `word` in the header.
std::size_t count_after(std::string_view header, std::string_view word) {
  const std::size_t at = header.find(word);
  std::size_t count = 0;
  for (std::size_t i = at + word.size(); at != std::string_view::npos && i < header.size(); ++i) {
    if (header[i] < '0' || header[i] > '9' || count > std::size_t{1} << 32) break;
    count = 10 * count + static_cast<std::size_t>(header[i] - '0');
  }
  return count;
}

template <class T>
T take(std::string_view& bytes) {
  T value;
  std::memcpy(&value, bytes.data(), sizeof value);
  bytes.remove_prefix(sizeof value);
  return value;
}

}  // namespace

std::string ply_of(const TriangleMesh& mesh) {
  std::string out = header_of(mesh.vertices_m.size(), mesh.triangles.size());
  const auto append = [&out](const auto& value) {
    out.append(reinterpret_cast<const char*>(&value), sizeof value);
  };
  for (const Eigen::Vector3f& vertex_m : mesh.vertices_m) {
    for (int k = 0; k < 3; ++k) append(vertex_m[k]);
  }
  for (const auto& triangle : mesh.triangles) {
    out.push_back(3);
    for (const std::uint32_t corner : triangle) append(corner);
  }
  return out;
}

TriangleMesh mesh_of_ply(std::string_view bytes) {
  const std::string_view header = bytes.substr(0, bytes.find("end_header"));
  const std::size_t vertices = count_after(header, "element vertex ");
  const std::size_t faces = count_after(header, "element face ");
  const std::string expected = header_of(vertices, faces);
  const std::size_t size = expected.size() + vertices * kVertexBytes + faces * kFaceBytes;
  if (!bytes.starts_with(expected) || bytes.size() != size) {
    throw std::runtime_error("no mesh that berth wrote; expected a PLY file of its triangles");
  }
  bytes.remove_prefix(expected.size());
  TriangleMesh mesh;
  for (std::size_t i = 0; i < vertices; ++i) {
    Eigen::Vector3f& vertex_m = mesh.vertices_m.emplace_back();
    for (int k = 0; k < 3; ++k) vertex_m[k] = take<float>(bytes);
    if (!vertex_m.allFinite()) {
      throw std::runtime_error(fmt::format("vertex {} is not finite; expected numbers", i));
    }
  }
  for (std::size_t i = 0; i < faces; ++i) {
    const auto corners = take<std::uint8_t>(bytes);
    auto& triangle = mesh.triangles.emplace_back();
    for (std::uint32_t& corner : triangle) corner = take<std::uint32_t>(bytes);
    if (corners == 3 && *std::ranges::max_element(triangle) < vertices) continue;
    throw std::runtime_error(
        fmt::format("face {}: expected 3 corners, each one of {} vertices", i, vertices));
  }
  return mesh;
}

}  // namespace berth
