// Inside space/ only: which small cubes may be occupied.
#pragma once

#include <span>

#include "berth/space/cubes.hpp"
#include "berth/space/unknown_space.hpp"

namespace berth::mesh {

/// The children of a cube that may hold an occupied point (D4), one bit each: a pixel that a child
/// projects into has F <= z <= F + t for some depth z in the child. Where that would be very many
/// pixels, right before a camera, they all may.
std::uint64_t find_occupied(std::span<const FreeingCamera> views, const Cube& cube);

}  // namespace berth::mesh
