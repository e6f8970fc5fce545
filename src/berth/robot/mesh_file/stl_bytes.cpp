#include "berth/robot/mesh_file/stl_bytes.hpp"

#include <bit>
#include <cstdint>

namespace berth {
namespace {

constexpr std::size_t kHeaderBytes = 80;

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
  bytes.resize(kHeaderBytes, ' ');
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
