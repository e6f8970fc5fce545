// Where the 64 children of a cube lie in it, many at a time.
#if defined(BERTH_MESH_CHILDREN_INL_HPP) == defined(HWY_TARGET_TOGGLE)
#ifdef BERTH_MESH_CHILDREN_INL_HPP
#undef BERTH_MESH_CHILDREN_INL_HPP
#else
#define BERTH_MESH_CHILDREN_INL_HPP
#endif

#include "berth/space/cubes.hpp"
#include "berth/vector/lanes-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace berth::mesh {
namespace HWY_NAMESPACE {
using namespace berth::HWY_NAMESPACE;

/// One point of each of some cubes.
struct CubePoints {
  Lanes x, y, z;
};

/// The corners of the children first, first + 1, ... (Cube::child), in edges of a child from the
/// cube's own corner.
HWY_INLINE CubePoints child_places(int first) {
  const Lanes place = count_up(static_cast<float>(first));
  const Lanes z = hn::Floor((place * Lanes(1.0f / 16)).v);
  const Lanes in_layer = place - z * Lanes(16.0f);
  const Lanes y = hn::Floor((in_layer * Lanes(0.25f)).v);
  return {in_layer - y * Lanes(4.0f), y, z};
}

/// Their centres in B, metres.
HWY_INLINE CubePoints child_centres(const Cube& cube, int first) {
  const CubePoints at = child_places(first);
  const Lanes edge_m(static_cast<float>(cube.edge_m() / 4)), middle(0.5f);
  const Eigen::Vector3f corner = cube.corner_m().cast<float>();
  return {mul_add(edge_m, at.x + middle, Lanes(corner.x())),
          mul_add(edge_m, at.y + middle, Lanes(corner.y())),
          mul_add(edge_m, at.z + middle, Lanes(corner.z()))};
}

/// Whether any of the children first to first + kLanes - 1 is among `wanted`.
HWY_INLINE bool has_wanted(std::uint64_t wanted, int first) {
  return (wanted >> first & ((std::uint64_t{1} << kLanes) - 1)) != 0;
}

}  // namespace HWY_NAMESPACE
}  // namespace berth::mesh
HWY_AFTER_NAMESPACE();

#endif
