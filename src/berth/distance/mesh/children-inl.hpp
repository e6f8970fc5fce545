// Where the 64 children of a cube lie in it, many at a time.
#if defined(BERTH_MESH_CHILDREN_INL_HPP) == defined(HWY_TARGET_TOGGLE)
#ifdef BERTH_MESH_CHILDREN_INL_HPP
#undef BERTH_MESH_CHILDREN_INL_HPP
#else
#define BERTH_MESH_CHILDREN_INL_HPP
#endif

#include "berth/vector/lanes-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace berth::mesh {
namespace HWY_NAMESPACE {
using namespace berth::HWY_NAMESPACE;

/// In edges of a child, from the cube's corner.
struct ChildPlaces {
  Lanes x, y, z;
};

/// Of the children first, first + 1, ... (Cube::child).
HWY_INLINE ChildPlaces child_places(int first) {
  const Lanes place = count_up(static_cast<float>(first));
  const Lanes z = hn::Floor((place * Lanes(1.0f / 16)).v);
  const Lanes in_layer = place - z * Lanes(16.0f);
  const Lanes y = hn::Floor((in_layer * Lanes(0.25f)).v);
  return {in_layer - y * Lanes(4.0f), y, z};
}

/// Whether any of the children first to first + kLanes - 1 is among `wanted`.
HWY_INLINE bool has_wanted(std::uint64_t wanted, int first) {
  return (wanted >> first & ((std::uint64_t{1} << kLanes) - 1)) != 0;
}

}  // namespace HWY_NAMESPACE
}  // namespace berth::mesh
HWY_AFTER_NAMESPACE();

#endif
