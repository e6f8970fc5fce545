#include "bench/subdivide.hpp"

#include <map>

namespace berth::bench {
namespace {

/// The middle of each edge once, so that neighbours share it.
class Middles {
 public:
  explicit Middles(std::vector<Eigen::Vector3f>& vertices_m) : vertices_m_(vertices_m) {}

  std::uint32_t operator()(std::uint32_t a, std::uint32_t b) {
    const auto next = static_cast<std::uint32_t>(vertices_m_.size());
    const auto [place, is_new] = middles_.try_emplace(std::minmax(a, b), next);
    if (is_new) {
      const Eigen::Vector3f middle_m = 0.5f * (vertices_m_[a] + vertices_m_[b]);
      vertices_m_.push_back(middle_m);
    }
    return place->second;
  }

 private:
  std::vector<Eigen::Vector3f>& vertices_m_;
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> middles_;
};

}  // namespace

TriangleMesh subdivide(const TriangleMesh& mesh) {
  TriangleMesh fine{mesh.vertices_m, {}};
  Middles middle(fine.vertices_m);
  for (const auto& [a, b, c] : mesh.triangles) {
    const std::uint32_t ab = middle(a, b);
    const std::uint32_t bc = middle(b, c);
    const std::uint32_t ca = middle(c, a);
    fine.triangles.push_back({a, ab, ca});
    fine.triangles.push_back({ab, b, bc});
    fine.triangles.push_back({ca, bc, c});
    fine.triangles.push_back({ab, bc, ca});
  }
  return fine;
}

}  // namespace berth::bench
